#pragma once

#include <facemap/mesh.h>

#include <vector>

namespace facemap::generators {

/// Corners of a polygon, or points of a line, in a plane.
using Outline = std::vector<glm::dvec2>;

/// Neighbouring facets that meet at a greater angle belong to different smoothing groups.
inline constexpr double kCreaseAngleCosine = 0.75;  // 41 degrees

/// A smoothing group for each edge i -> i + 1: 1 and 2 in turn, changing at creases. A closed outline whose
/// number of creases is odd uses 3 for its last stretch.
std::vector<int> crease_groups(const Outline& outline, bool closed);

/// Cuts a simple counter-clockwise polygon into size - 2 triangles by its ears, the fullest first.
std::vector<Corners> triangulate(const Outline& polygon);

/// A counter-clockwise polygon with each edge moved inwards by `distance`.
Outline inset(const Outline& polygon, double distance);

/// The points of a uniform Catmull-Rom curve through `knots`, `segments` from one knot to the next. An open curve
/// keeps its end knots; a closed one runs back to the first and does not repeat it.
Outline smooth_curve(const Outline& knots, int segments, bool closed);

/// A rectangle with corners rounded by quarter circles of `segments` each, counter-clockwise.
Outline rounded_rectangle(glm::dvec2 lower, glm::dvec2 upper, double radius, int segments);

}  // namespace facemap::generators
