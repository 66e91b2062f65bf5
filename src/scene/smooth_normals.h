#pragma once

#include <facemap/mesh.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facemap {

/// The smoothing group (0: none) of the triangles from `first_triangle` on, up to the next run.
struct SmoothingRun {
  std::size_t first_triangle;
  std::uint32_t group;
};

/// Gives a normal to each corner that has none and lies in a smoothing group: the sum of the area vectors of the
/// polygons of its group about its vertex, of unit length. A corner whose sum vanishes keeps none. How a polygon
/// was cut into triangles makes no difference but for rounding. Runs ascend; before the first there is no group.
void add_smooth_normals(Mesh& mesh, const std::vector<SmoothingRun>& runs);

}  // namespace facemap
