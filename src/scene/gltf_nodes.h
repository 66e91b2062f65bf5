#pragma once

#include <cstdint>
#include <vector>

#include "scene/affine.h"
#include "scene/gltf_file.h"

namespace facemap {

/// A node of the scene that is shown.
struct GltfNode {
  std::uint32_t index;
  GltfValue value;
  Affine world;  ///< from the node's coordinates to the world's
};

/// The nodes of the scene, parents before children: of the file's default scene, or its first, or all nodes if it has
/// none. Throws LoadError if nodes do not form trees, or the scene names one that is not the root of one.
std::vector<GltfNode> list_gltf_nodes(const GltfFile& file);

/// The rotation by a quaternion (x, y, z, w) of any length but 0.
Affine rotation_of(const double (&quaternion)[4]);

/// Scales, then turns, then moves.
Affine compose(const DVector& translation, const Affine& rotation, const DVector& scale);

}  // namespace facemap
