#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "scene/face_neighbours.h"

namespace facemap {

/// What lies behind surfaces for certain. A patch is a set of faces that are connected by their edges and all turned
/// the same way, towards a light or away from it. Seen from the light, the number of a patch's faces that lie in a
/// direction changes only across an edge with just one of its faces: each face counts 1, whichever way it is folded.
/// So in a texel that no such edge meets, and where the patch is known to have a face in one direction, it has one in
/// every direction; and a point of the texel that is farther than the farthest bit of the patch there is blocked.
///
/// `places`: (u, v, w) of the vertices, w above 0, three floats each; `size`: texels a side. Gives for each texel a w
/// such that each point of a lesser one is blocked, or 0.
std::vector<float> find_dark(const Scene& scene, const std::vector<FaceNeighbours>& neighbours,
                             const std::vector<float>& places, int size);

}  // namespace facemap
