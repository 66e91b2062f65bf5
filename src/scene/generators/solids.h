#pragma once

#include <facemap/mesh.h>
#include <facemap/vector.h>

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "scene/generators/outline.h"

namespace facemap::generators {

/// A piece of surface under construction, in its own coordinates. Triangles are counter-clockwise seen from
/// outside; each has a smoothing group (0: flat).
struct Solid {
  std::vector<DVector> points;
  std::vector<Corners> triangles;
  std::vector<std::uint8_t> groups;

  std::uint32_t add_point(const DVector& point);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, int group);

  /// Corners in counter-clockwise order; split along a-c.
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, int group);

  /// Appends another solid; no points are merged.
  void add(const Solid& other);
};

/// Indices of points around a loop.
using Ring = std::vector<std::uint32_t>;

/// A rigid motion, or with three other axes any affine map: point -> origin + x px + y py + z pz.
struct Placement {
  DVector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  DVector operator()(const DVector& point) const { return origin + x * point.x + y * point.y + z * point.z; }
  bool mirrors() const { return dot(cross(x, y), z) < 0; }
};

Placement moved(const DVector& to);

/// A turn about an axis through the origin by a right-handed angle, then a move.
Placement turned_about_x(double angle_rad, const DVector& to = DVector(0));
Placement turned_about_y(double angle_rad, const DVector& to = DVector(0));
Placement turned_about_z(double angle_rad, const DVector& to = DVector(0));

/// First `inner`, then `outer`.
Placement composed(const Placement& outer, const Placement& inner);

/// A copy moved by `placement`; triangles are turned over if it mirrors.
Solid placed(const Solid& solid, const Placement& placement);

/// The strip between two loops of equally many points. Seen from outside, `upper` lies on the left of the
/// direction in which both loops run.
void bridge(Solid& solid, const Ring& lower, const Ring& upper, int group);

/// The same between two open rows of points.
void bridge_open(Solid& solid, const Ring& lower, const Ring& upper, int group);

/// Closes a loop with a fan around `pole`, which lies on the loop's left.
void cap(Solid& solid, const Ring& ring, std::uint32_t pole, int group);

/// The same for a pole on the loop's right.
void cap_right(Solid& solid, const Ring& ring, std::uint32_t pole, int group);

/// A box with its edges cut at 45 degrees by `bevel` (0: plain, 12 faces; else 60), flat-shaded.
Solid box(const DVector& lower, const DVector& upper, double bevel);

/// A simple closed outline in the plane z = 0, counter-clockwise, stretched from z = -depth / 2 to depth / 2. The
/// edges of both ends are cut at 45 degrees by `bevel` (0: sharp); edges next to a convex crease must be longer
/// than it. Sides are smooth where the outline turns by less than kCreaseAngleCosine.
Solid extrude(const Outline& outline, double depth, double bevel);

/// A closed sheet: a line in the plane z = 0, given a thickness to its left and stretched from z = -width / 2 to
/// width / 2.
Solid sheet(const Outline& line, double thickness, double width);

/// A round bar along a path, `sides` points around, with flat closed ends. `radii`: one a point of the path.
Solid bar(const std::vector<DVector>& path, const std::vector<double>& radii, int sides);

}  // namespace facemap::generators
