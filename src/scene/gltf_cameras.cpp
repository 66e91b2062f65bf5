#include <algorithm>
#include <cmath>
#include <string>

#include "math/elementary.h"
#include "scene/gltf_lights.h"

namespace facemap {

namespace {

void read_perspective(const GltfFile& file, const GltfValue& value, ModelCamera& camera) {
  const double angle = value.number("yfov", camera.field_angle);
  if (angle > 0 && angle < elementary::kPi) {
    camera.field_angle = angle;
  } else {
    file.warn(value, "a camera's yfov is not between 0 and pi");
  }
}

void read_orthographic(const GltfFile& file, const GltfValue& value, ModelCamera& camera) {
  camera.is_parallel = true;
  const double half = std::fabs(value.number("ymag", camera.height / 2));
  if (half > 0) {
    camera.height = 2 * half;
  } else {
    file.warn(value, "a camera's ymag is 0");
  }
}

/// Looks along the node's -z. The point looked at is so far away that rounding it hardly turns the view.
void place(const Affine& world, ModelCamera& camera) {
  const DVector eye = world.origin;
  const double distance = std::max({1.0, std::fabs(eye.x), std::fabs(eye.y), std::fabs(eye.z)});
  camera.position = Vector(eye);
  camera.look_at = Vector(eye + distance * unit_or_zero(world.direction({0, 0, -1})));
  camera.up = Vector(unit_or_zero(world.direction({0, 1, 0})));
}

bool is_finite(const Vector& v) { return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0; }

}  // namespace

std::optional<ModelCamera> read_gltf_camera(const GltfFile& file, const GltfNode& node) {
  const std::optional<GltfValue> index = node.value.find("camera");
  if (!index) return std::nullopt;
  const GltfValue value = file.root.element("cameras", index->as_index(), *index);
  ModelCamera camera;
  camera.name = value.text("name", node.value.text("name", value.path()));
  place(node.world, camera);
  const std::string type = value.at("type").as_text();
  if (type == "perspective") {
    read_perspective(file, value.at("perspective"), camera);
  } else if (type == "orthographic") {
    read_orthographic(file, value.at("orthographic"), camera);
  } else {
    file.warn(value, "a camera of an unknown type is left out");
    return std::nullopt;
  }
  if (!is_finite(camera.position) || !is_finite(camera.look_at) || camera.look_at == camera.position ||
      camera.up == Vector(0)) {
    file.warn(node.value, "a camera whose node gives no view is left out");
    return std::nullopt;
  }
  return camera;
}

}  // namespace facemap
