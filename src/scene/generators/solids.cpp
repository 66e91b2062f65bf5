#include "scene/generators/solids.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"

namespace facemap::generators {
namespace {

// Smoothing groups of an extruded solid: the sides use those of crease_groups, the bevels these beside them.
constexpr int kFrontBevel = 3, kBackBevel = 6;

Ring add_outline(Solid& solid, const Outline& outline, double z) {
  Ring ring;
  for (const glm::dvec2& p : outline) ring.push_back(solid.add_point({p.x, p.y, z}));
  return ring;
}

void bridge_by_edges(Solid& solid, const Ring& lower, const Ring& upper, const std::vector<int>& groups, int shift) {
  const std::size_t n = lower.size();
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t k = (j + 1) % n;
    solid.add_quad(lower[j], lower[k], upper[k], upper[j], groups[j] + shift);
  }
}

// Two unit vectors across `direction`, nearly those of the step before.
void turn_frame(const DVector& direction, DVector& u, DVector& v) {
  u = normalize(u - direction * dot(u, direction));
  v = cross(direction, u);
}

}  // namespace

std::uint32_t Solid::add_point(const DVector& point) {
  points.push_back(point);
  return static_cast<std::uint32_t>(points.size() - 1);
}

void Solid::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, int group) {
  triangles.push_back({a, b, c});
  groups.push_back(static_cast<std::uint8_t>(group));
}

void Solid::add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, int group) {
  add_triangle(a, b, c, group);
  add_triangle(a, c, d, group);
}

void Solid::add(const Solid& other) {
  const auto shift = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (const Corners& t : other.triangles) triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  groups.insert(groups.end(), other.groups.begin(), other.groups.end());
}

Placement moved(const DVector& to) {
  Placement placement;
  placement.origin = to;
  return placement;
}

Placement turned_about_x(double angle_rad, const DVector& to) {
  const double c = elementary::cos(angle_rad), s = elementary::sin(angle_rad);
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}, to};
}

Placement turned_about_y(double angle_rad, const DVector& to) {
  const double c = elementary::cos(angle_rad), s = elementary::sin(angle_rad);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, to};
}

Placement turned_about_z(double angle_rad, const DVector& to) {
  const double c = elementary::cos(angle_rad), s = elementary::sin(angle_rad);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}, to};
}

Placement composed(const Placement& outer, const Placement& inner) {
  const DVector at = outer(inner.origin);
  return {outer(inner.x) - outer.origin, outer(inner.y) - outer.origin, outer(inner.z) - outer.origin, at};
}

Solid placed(const Solid& solid, const Placement& placement) {
  Solid result = solid;
  for (DVector& p : result.points) p = placement(p);
  if (placement.mirrors()) {
    for (Corners& t : result.triangles) std::swap(t[1], t[2]);
  }
  return result;
}

void bridge(Solid& solid, const Ring& lower, const Ring& upper, int group) {
  const std::size_t n = lower.size();
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t k = (j + 1) % n;
    solid.add_quad(lower[j], lower[k], upper[k], upper[j], group);
  }
}

void bridge_open(Solid& solid, const Ring& lower, const Ring& upper, int group) {
  for (std::size_t j = 0; j + 1 < lower.size(); ++j) {
    solid.add_quad(lower[j], lower[j + 1], upper[j + 1], upper[j], group);
  }
}

void cap(Solid& solid, const Ring& ring, std::uint32_t pole, int group) {
  for (std::size_t j = 0; j < ring.size(); ++j) solid.add_triangle(ring[j], ring[(j + 1) % ring.size()], pole, group);
}

void cap_right(Solid& solid, const Ring& ring, std::uint32_t pole, int group) {
  for (std::size_t j = 0; j < ring.size(); ++j) solid.add_triangle(ring[(j + 1) % ring.size()], ring[j], pole, group);
}

Solid box(const DVector& lower, const DVector& upper, double bevel) {
  const Outline outline{{lower.x, lower.y}, {upper.x, lower.y}, {upper.x, upper.y}, {lower.x, upper.y}};
  Outline cut;
  if (bevel > 0) {
    for (int i = 0; i < 4; ++i) {
      const glm::dvec2 before = outline[(i + 3) % 4], here = outline[i], after = outline[(i + 1) % 4];
      cut.push_back(here + normalize(before - here) * bevel);
      cut.push_back(here + normalize(after - here) * bevel);
    }
  }
  Solid solid = extrude(bevel > 0 ? cut : outline, upper.z - lower.z, bevel);
  for (std::uint8_t& group : solid.groups) group = 0;
  return placed(solid, moved({0, 0, (lower.z + upper.z) / 2}));
}

Solid extrude(const Outline& outline, double depth, double bevel) {
  Solid solid;
  const std::vector<int> groups = crease_groups(outline, true);
  const double side = depth / 2 - bevel;
  const Ring back = add_outline(solid, outline, -side), front = add_outline(solid, outline, side);
  bridge_by_edges(solid, back, front, groups, 0);
  Ring back_end = back, front_end = front;
  Outline end = outline;
  if (bevel > 0) {
    end = inset(outline, bevel);
    back_end = add_outline(solid, end, -depth / 2);
    front_end = add_outline(solid, end, depth / 2);
    bridge_by_edges(solid, back_end, back, groups, kBackBevel);
    bridge_by_edges(solid, front, front_end, groups, kFrontBevel);
  }
  for (const Corners& t : triangulate(end)) {
    solid.add_triangle(front_end[t[0]], front_end[t[1]], front_end[t[2]], 0);
    solid.add_triangle(back_end[t[0]], back_end[t[2]], back_end[t[1]], 0);
  }
  return solid;
}

Solid sheet(const Outline& line, double thickness, double width) {
  Solid solid;
  Outline shifted;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::dvec2 along = normalize(line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]);
    shifted.push_back(line[i] + thickness * glm::dvec2(-along.y, along.x));
  }
  const Ring right_back = add_outline(solid, line, -width / 2), right_front = add_outline(solid, line, width / 2);
  const Ring left_back = add_outline(solid, shifted, -width / 2), left_front = add_outline(solid, shifted, width / 2);
  bridge_open(solid, right_back, right_front, 1);
  bridge_open(solid, left_front, left_back, 2);
  bridge_open(solid, right_front, left_front, 3);
  bridge_open(solid, left_back, right_back, 3);
  const std::size_t last = line.size() - 1;
  solid.add_quad(right_back[0], right_front[0], left_front[0], left_back[0], 0);
  solid.add_quad(right_front[last], right_back[last], left_back[last], left_front[last], 0);
  return solid;
}

Solid bar(const std::vector<DVector>& path, const std::vector<double>& radii, int sides) {
  Solid solid;
  const std::size_t n = path.size();
  DVector direction = normalize(path[1] - path[0]);
  DVector u = std::abs(direction.x) < 0.9 ? DVector(1, 0, 0) : DVector(0, 1, 0), v;
  Ring before;
  for (std::size_t i = 0; i < n; ++i) {
    direction = normalize(path[i + 1 < n ? i + 1 : i] - path[i > 0 ? i - 1 : 0]);
    turn_frame(direction, u, v);
    Ring ring;
    for (int j = 0; j < sides; ++j) {
      const double angle = 2 * elementary::kPi * j / sides;
      ring.push_back(solid.add_point(path[i] + radii[i] * (elementary::cos(angle) * u + elementary::sin(angle) * v)));
    }
    if (i == 0) {
      cap_right(solid, ring, solid.add_point(path[0]), 0);
    } else {
      bridge(solid, before, ring, 1);
    }
    before = ring;
  }
  cap(solid, before, solid.add_point(path[n - 1]), 0);
  return solid;
}

}  // namespace facemap::generators
