// Any bytes are a glTF file, JSON or GLB, or are refused: nothing else may happen. What was read must make a scene.

#include <facemap/error.h>
#include <facemap/scene.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "scene/gltf.h"

namespace {

void check(facemap::Model model, const facemap::ModelLimits& limits) {
  const std::size_t faces = model.mesh.face_count();
  if (faces == 0 || faces > limits.max_faces || model.triangle_objects.size() != faces) std::abort();
  for (const std::uint32_t object : model.triangle_objects) {
    if (object >= model.objects.size()) std::abort();
  }
  for (const facemap::Material& material : model.materials) {
    for (const auto* const map : {&material.diffuse_map, &material.roughness_map, &material.metallic_map,
                                  &material.normal_map, &material.emission_map, &material.specular_map}) {
      if (map->is_used() && map->image >= model.images.size()) std::abort();
    }
  }
  for (const facemap::Vector& normal : model.mesh.normals) {
    if (!(glm::dot(normal, normal) < 2)) std::abort();
  }
  // Throws Error if an index or a position is wrong.
  const facemap::Scene scene(std::move(model.mesh), std::move(model.materials));
  if (scene.face_count() != faces) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facemap;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ModelLimits limits;
  limits.max_faces = 1 << 16;
  try {
    check(read_gltf(bytes, "fuzz.gltf", "no/such/folder", limits), limits);
  } catch (const LoadError& refused) {
    if (refused.line() < 0 || refused.reason().empty()) std::abort();
  } catch (const Error&) {
    std::abort();
  }
  return 0;
}
