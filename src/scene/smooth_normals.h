#pragma once

#include <cstdint>
#include <vector>

#include <facemap/mesh.h>

namespace facemap {

/// Gives a normal to each corner that has none and lies in a smoothing group (one a triangle; 0: none): the sum
/// of the area vectors of the polygons of its group about its vertex, of unit length. A corner whose sum vanishes
/// keeps none. How a polygon was cut into triangles makes no difference but for rounding.
void add_smooth_normals(Mesh& mesh, const std::vector<std::uint32_t>& smoothing_groups);

}  // namespace facemap
