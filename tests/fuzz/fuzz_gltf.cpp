// Any bytes are a glTF file, JSON or GLB, or are refused: nothing else may happen. What was read must make a scene.

#include <glm/geometric.hpp>

#include "fuzz/fuzz_model.h"
#include "scene/gltf.h"

namespace {

// What only glTF's reader promises.
void check_parts(const facemap::Model& model) {
  if (model.triangle_objects.size() != model.mesh.face_count()) std::abort();
  for (const facemap::Material& material : model.materials) {
    for (const auto* const map : {&material.diffuse_map, &material.roughness_map, &material.metallic_map,
                                  &material.normal_map, &material.emission_map, &material.specular_map}) {
      if (map->is_used() && map->image >= model.images.size()) std::abort();
    }
  }
  for (const facemap::Vector& normal : model.mesh.normals) {
    if (!(glm::dot(normal, normal) < 2)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return facemap::fuzz_model(data, size, [](std::string_view bytes, const facemap::ModelLimits& limits) {
    facemap::Model model = facemap::read_gltf(bytes, "fuzz.gltf", "no/such/folder", limits);
    check_parts(model);
    return model;
  });
}
