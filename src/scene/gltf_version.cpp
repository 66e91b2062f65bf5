#include <algorithm>
#include <string>

#include "scene/gltf_file.h"
#include "scene/obj_lines.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

constexpr std::string_view kRead[] = {
    "KHR_lights_punctual",     "KHR_materials_emissive_strength", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",     "KHR_mesh_quantization",           "KHR_texture_transform",
    "EXT_mesh_gpu_instancing",
};

/// Without them a model is all there, and looks a little different at most: they may even be required.
constexpr std::string_view kHarmless[] = {
    "KHR_animation_pointer",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_xmp",
    "KHR_xmp_json_ld",
};

template <std::size_t kCount>
bool contains(const std::string_view (&names)[kCount], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// "2.1" is version 2.
int major_version(const std::string& version) {
  const bool has_digit = !version.empty() && version[0] >= '0' && version[0] <= '9';
  return has_digit && (version.size() == 1 || version[1] == '.') ? version[0] - '0' : -1;
}

void check_asset(const GltfValue& asset) {
  const std::string version = asset.at("version").as_text();
  if (major_version(version) != 2) {
    asset.fail(Cause::Unsupported, "glTF of version \"" + printable(version) + "\"; version 2.0 is read");
  }
  const std::string least = asset.text("minVersion", "2.0");
  if (least != "2.0") {
    asset.fail(Cause::Unsupported, "needs a reader of version \"" + printable(least) + "\"; this one is of 2.0");
  }
}

}  // namespace

void check_gltf_version(const GltfFile& file) {
  check_asset(file.root.at("asset"));
  for (const GltfValue& extension : file.root.elements("extensionsRequired")) {
    const std::string name = extension.as_text();
    if (contains(kRead, name) || contains(kHarmless, name)) continue;
    extension.fail(Cause::Unsupported, "requires the extension " + printable(name) + ", which is not read");
  }
  for (const GltfValue& extension : file.root.elements("extensionsUsed")) {
    const std::string name = extension.as_text();
    if (!contains(kRead, name)) file.warnings.add(0, "an extension is ignored", name);
  }
}

}  // namespace facemap
