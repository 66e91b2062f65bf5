#include "scene/gltf.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "scene/gltf_container.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_mesh.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

void read_meshes(const GltfFile& file, GltfBuffers& buffers, const std::vector<std::uint32_t>& coordinate_sets,
                 const std::vector<GltfNode>& nodes, Model& model) {
  GltfAccessors accessors(file, buffers);
  GltfSurfaces surfaces(file, accessors, coordinate_sets);
  GltfMeshBuilder builder(file, accessors, surfaces, nodes, model);
  for (const GltfNode& node : nodes) builder.add(node);
  builder.finish();
}

void read_model(const GltfFile& file, Model& model) {
  check_gltf_version(file);
  GltfBuffers buffers(file);
  GltfImages images(file, buffers, model.images);
  GltfMaterials materials = read_gltf_materials(file, images);
  model.materials = std::move(materials.materials);
  const std::vector<GltfNode> nodes = list_gltf_nodes(file);
  for (const GltfNode& node : nodes) {
    if (const auto light = read_gltf_light(file, node)) model.lights.push_back(*light);
    if (const auto camera = read_gltf_camera(file, node)) model.cameras.push_back(*camera);
  }
  read_meshes(file, buffers, materials.coordinate_sets, nodes, model);
  if (file.root.count("animations") > 0) file.warnings.add(0, "animations are ignored");
  model.up = Vector(0, 1, 0);
}

}  // namespace

Model read_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& directory,
                const ModelLimits& limits) {
  const FloatingPointMode mode;
  if (bytes.size() > limits.max_bytes) {
    throw LoadError(Cause::TooLarge, name, 0, "more than " + std::to_string(limits.max_bytes) + " bytes");
  }
  const GltfContainer container = GltfContainer::open(bytes, name);
  const nlohmann::json json = parse_json(container.json, name);
  ObjWarnings warnings(name);
  const GltfFile file{GltfValue(json, name), container.binary, bytes.size(), directory, limits, warnings};
  Model model;
  read_model(file, model);
  if (model.mesh.triangles.empty()) throw LoadError(Cause::NoFaces, name, 0, "no faces");
  warnings.append_to(model.warnings);
  return model;
}

}  // namespace facemap
