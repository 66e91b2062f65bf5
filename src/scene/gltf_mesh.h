#pragma once

#include <facemap/model.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/gltf_skin.h"

namespace facemap {

/// Puts the meshes of a glTF file's nodes into one mesh, in world coordinates.
class GltfMeshBuilder {
 public:
  /// `nodes` are those that will be added: each mesh is kept as long as one of them needs it, and no longer.
  GltfMeshBuilder(const GltfFile& file, GltfAccessors& accessors, GltfSurfaces& surfaces,
                  const std::vector<GltfNode>& nodes, Model& model);

  /// Adds the node's mesh as an object: once, or once for each of its instances (EXT_mesh_gpu_instancing). What hangs
  /// on a skin stands where the skin's joints put it.
  void add(const GltfNode& node);

  /// Completes the arrays that only some surfaces had values for.
  void finish();

 private:
  struct KeptMesh {
    std::uint64_t uses = 0;
    bool is_read = false;
    std::vector<GltfSurface> surfaces;
  };

  void read(KeptMesh& mesh, const GltfValue& value);
  std::vector<Affine> instances(const GltfNode& node);
  void add_surface(const GltfNode& node, const Affine& world, const GltfSurface& surface, std::uint32_t object);
  void check_room(const GltfNode& node, const GltfSurface& surface) const;
  void add_positions(const GltfNode& node, const Affine& world, const GltfSurface& surface);
  void add_normals(const Affine& world, const GltfSurface& surface);
  void add_corners(std::vector<Corners>& corners, std::size_t face_count, std::size_t first, const Affine& world,
                   const GltfSurface& surface) const;

  const GltfFile& file_;
  GltfAccessors& accessors_;
  GltfSurfaces& surfaces_;
  GltfSkins skins_;
  Model& model_;
  Mesh& mesh_;
  std::map<std::uint32_t, KeptMesh> meshes_;
};

}  // namespace facemap
