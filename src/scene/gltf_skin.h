#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "scene/gltf_nodes.h"
#include "scene/gltf_surface.h"

namespace facemap {

/// The skins of a glTF file as its nodes stand: where each joint moves what hangs on it.
class GltfSkins {
 public:
  GltfSkins(const GltfFile& file, GltfAccessors& accessors, const std::vector<GltfNode>& nodes);

  /// A surface that hangs on the node's skin, in world coordinates. Throws LoadError if it names a joint that is not
  /// there.
  GltfSurface pose(const GltfNode& node, const GltfSurface& surface);

 private:
  const std::vector<Affine>& joints(const GltfNode& node);
  std::vector<Affine> read(const GltfNode& node, const GltfValue& skin) const;

  const GltfFile& file_;
  GltfAccessors& accessors_;
  std::map<std::uint32_t, Affine> worlds_;               ///< of nodes
  std::map<std::uint32_t, std::vector<Affine>> joints_;  ///< of skins, from a mesh's coordinates to the world's
};

}  // namespace facemap
