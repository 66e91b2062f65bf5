#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf_images.h"

namespace facemap {

/// What the materials of a glTF file are, and which texture coordinates each of them needs.
struct GltfMaterials {
  std::vector<Material> materials;
  std::vector<std::uint32_t> coordinate_sets;  ///< one a material
};

/// Throws LoadError for values that are of the wrong type; maps that cannot be used are left out with a warning.
GltfMaterials read_gltf_materials(const GltfFile& file, GltfImages& images);

}  // namespace facemap
