#include "scene/gltf_materials.h"

#include <algorithm>
#include <array>
#include <string>

#include "scene/obj_lines.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

constexpr float kMostShininess = 1000;  ///< the largest that MTL has

Vector colour_of(const double* numbers) {
  return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

float fraction(const GltfValue& value, std::string_view key, double otherwise) {
  return static_cast<float>(std::clamp(value.number(key, otherwise), 0.0, 1.0));
}

/// Reads one element of "materials".
class MaterialReader {
 public:
  MaterialReader(const GltfFile& file, GltfImages& images, const GltfValue& value)
      : file_(file), images_(images), value_(value) {}

  Material read() {
    material_.name = value_.text("name", "");
    material_.diffuse = Vector(1);
    material_.kind = Material::Kind::MetalRough;
    if (const auto glossy = value_.extension("KHR_materials_pbrSpecularGlossiness")) {
      read_specular_glossiness(*glossy);
    } else {
      read_metallic_roughness();
    }
    read_normal_map();
    read_emission();
    read_alpha();
    material_.is_double_sided = value_.flag("doubleSided", false);
    material_.is_unlit = value_.extension("KHR_materials_unlit").has_value();
    if (value_.find("occlusionTexture")) file_.warn(value_, "a map of occlusion is ignored: shadows are computed");
    return std::move(material_);
  }

  std::uint32_t coordinate_set() const { return coordinate_set_.value_or(0); }

 private:
  void read_metallic_roughness() {
    material_.metallic = material_.roughness = 1;
    const std::optional<GltfValue> rough = value_.find("pbrMetallicRoughness");
    if (!rough) return;
    read_base_colour(*rough, "baseColorFactor", "baseColorTexture");
    material_.metallic = fraction(*rough, "metallicFactor", 1);
    material_.roughness = fraction(*rough, "roughnessFactor", 1);
    material_.roughness_map = map(*rough, "metallicRoughnessTexture");
    material_.roughness_map.channel = 1;
    material_.metallic_map = material_.roughness_map;
    material_.metallic_map.channel = 2;
  }

  void read_specular_glossiness(const GltfValue& glossy) {
    material_.kind = Material::Kind::Phong;
    read_base_colour(glossy, "diffuseFactor", "diffuseTexture");
    material_.specular = colour_of(glossy.numbers<3>("specularFactor", {1, 1, 1}).data());
    material_.specular_map = map(glossy, "specularGlossinessTexture");
    // A Blinn-Phong highlight is about as wide as that of a rough surface if n = 2 / alpha^2 - 2, alpha = roughness^2.
    const float roughness = 1 - fraction(glossy, "glossinessFactor", 1), alpha = roughness * roughness;
    const float width = std::max(alpha * alpha, 2 / (kMostShininess + 2));
    material_.shininess = std::max(2 / width - 2, 0.0f);
  }

  void read_base_colour(const GltfValue& holder, std::string_view factor, std::string_view texture) {
    const auto colour = holder.numbers<4>(factor, {1, 1, 1, 1});
    material_.diffuse = colour_of(colour.data());
    material_.opacity = static_cast<float>(std::clamp(colour[3], 0.0, 1.0));
    material_.diffuse_map = map(holder, texture);
  }

  void read_normal_map() {
    material_.normal_map = map(value_, "normalTexture");
    if (const auto info = value_.find("normalTexture")) {
      material_.normal_map.strength = static_cast<float>(info->number("scale", 1));
    }
  }

  void read_emission() {
    const Vector factor = colour_of(value_.numbers<3>("emissiveFactor", {0, 0, 0}).data());
    const auto strong = value_.extension("KHR_materials_emissive_strength");
    material_.emission = factor * (strong ? static_cast<float>(strong->number("emissiveStrength", 1)) : 1.0f);
    material_.emission_map = map(value_, "emissiveTexture");
  }

  void read_alpha() {
    const std::string mode = value_.text("alphaMode", "OPAQUE");
    if (mode == "MASK") {
      material_.alpha = Material::Alpha::Mask;
      material_.alpha_cutoff = static_cast<float>(value_.number("alphaCutoff", 0.5));
    } else if (mode == "BLEND") {
      material_.alpha = Material::Alpha::Blend;
    } else {
      if (mode != "OPAQUE") file_.warn(value_.at("alphaMode"), "an unknown alphaMode counts as OPAQUE");
      material_.opacity = 1;  // whatever the alpha
    }
  }

  /// The map that `holder[key]` names, if there is one. Its coordinates have to be those of the maps before it.
  TextureUse map(const GltfValue& holder, std::string_view key) {
    const std::optional<GltfValue> info = holder.find(key);
    if (!info) return {};
    const std::uint32_t set = GltfImages::coordinate_set(*info);
    if (coordinate_set_.value_or(set) != set) {
      file_.warn(*info, "a map with other texture coordinates than the base colour's is left out");
      return {};
    }
    const TextureUse use = images_.texture(*info);
    if (use.is_used()) coordinate_set_ = set;
    return use;
  }

  const GltfFile& file_;
  GltfImages& images_;
  const GltfValue& value_;
  Material material_;
  std::optional<std::uint32_t> coordinate_set_;
};

}  // namespace

GltfMaterials read_gltf_materials(const GltfFile& file, GltfImages& images) {
  GltfMaterials result;
  for (const GltfValue& value : file.root.elements("materials")) {
    MaterialReader reader(file, images, value);
    result.materials.push_back(reader.read());
    result.coordinate_sets.push_back(reader.coordinate_set());
  }
  return result;
}

}  // namespace facemap
