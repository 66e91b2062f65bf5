#include "scene/gltf_lights.h"

#include <algorithm>
#include <string>

#include "math/elementary.h"

namespace facemap {

namespace {

constexpr std::string_view kExtension = "KHR_lights_punctual";
constexpr double kRightAngle = elementary::kPi / 2;

/// Both cones within 0 and a right angle, the inner one within the outer.
void read_cone(const GltfFile& file, const GltfValue& value, Light& light) {
  light.inner_angle = 0;
  light.outer_angle = elementary::kPi / 4;
  const std::optional<GltfValue> spot = value.find("spot");
  if (!spot) return file.warn(value, "a spot light without \"spot\" has the usual cone");
  const double inner = spot->number("innerConeAngle", light.inner_angle);
  const double outer = spot->number("outerConeAngle", light.outer_angle);
  light.outer_angle = std::clamp(outer, 0.0, kRightAngle);
  light.inner_angle = std::clamp(inner, 0.0, light.outer_angle);
  if (light.inner_angle != inner || light.outer_angle != outer || inner >= outer) {
    file.warn(*spot, "cone angles out of their ranges are taken as the nearest that are not");
  }
}

std::optional<Light> read_kind(const GltfFile& file, const GltfValue& value) {
  Light light;
  const std::string type = value.at("type").as_text();
  if (type == "point") {
    light.kind = Light::Kind::Point;
  } else if (type == "spot") {
    light.kind = Light::Kind::Spot;
    read_cone(file, value, light);
  } else if (type == "directional") {
    light.kind = Light::Kind::Directional;
  } else {
    file.warn(value, "a light of an unknown type is left out");
    return std::nullopt;
  }
  return light;
}

void read_strength(const GltfFile& file, const GltfValue& value, Light& light) {
  const auto colour = value.numbers<3>("color", {1, 1, 1});
  light.color = {static_cast<float>(colour[0]), static_cast<float>(colour[1]), static_cast<float>(colour[2])};
  light.intensity = static_cast<float>(value.number("intensity", 1));
  if (light.kind == Light::Kind::Directional) return;  // neither falloff nor range
  light.has_falloff = true;
  const double range = value.number("range", light.range);
  if (range > 0) {
    light.range = range;
  } else {
    file.warn(value, "a range that is not above 0 is ignored");
  }
}

}  // namespace

std::optional<Light> read_gltf_light(const GltfFile& file, const GltfNode& node) {
  const std::optional<GltfValue> use = node.value.extension(kExtension);
  if (!use) return std::nullopt;
  const GltfValue index = use->at("light");
  const std::optional<GltfValue> holder = file.root.extension(kExtension);
  if (!holder) index.fail(LoadError::Cause::BadIndex, "names a light of a file without any");
  const GltfValue value = holder->element("lights", index.as_index(), index);
  std::optional<Light> light = read_kind(file, value);
  if (!light) return std::nullopt;
  read_strength(file, value, *light);
  // A node's scale changes neither strength nor range.
  light->position = Vector(node.world.origin);
  light->direction = Vector(unit_or_zero(node.world.direction({0, 0, -1})));
  const Vector& p = light->position;
  if ((p.x - p.x) + (p.y - p.y) + (p.z - p.z) != 0 || light->direction == Vector(0)) {
    file.warn(node.value, "a light whose node gives no place or direction is left out");
    return std::nullopt;
  }
  return light;
}

}  // namespace facemap
