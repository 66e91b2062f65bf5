#include "scene/generators/lathe.h"

#include <cmath>

#include "math/elementary.h"

namespace facemap::generators {

Profile::Profile(double radius, double height, int detail) : points_{{radius, height}}, detail_(detail) {}

Profile& Profile::line(double radius, double height) {
  points_.push_back({radius, height});
  return *this;
}

Profile& Profile::arc(double radius, double height, double bulge, int segments) {
  const glm::dvec2 from = points_.back(), to(radius, height), half = (to - from) * 0.5;
  // From the middle of the chord to the centre: away from the swelling side, by (1 - bulge^2) / (2 bulge) of its half.
  const glm::dvec2 centre = from + half + glm::dvec2(-half.y, half.x) * ((1 - bulge * bulge) / (2 * bulge));
  const double angle = 4 * elementary::atan2(bulge, 1);
  const int n = segments * detail_;
  for (int k = 1; k < n; ++k) {
    const double c = elementary::cos(angle * k / n), s = elementary::sin(angle * k / n);
    const glm::dvec2 d = from - centre;
    points_.push_back(centre + glm::dvec2(c * d.x - s * d.y, s * d.x + c * d.y));
  }
  points_.push_back(to);
  return *this;
}

Profile& Profile::curve(double control_radius, double control_height, double radius, double height, int segments) {
  const glm::dvec2 from = points_.back(), control(control_radius, control_height), to(radius, height);
  const int n = segments * detail_;
  for (int k = 1; k < n; ++k) {
    const double t = double(k) / n;
    points_.push_back((1 - t) * (1 - t) * from + 2 * t * (1 - t) * control + t * t * to);
  }
  points_.push_back(to);
  return *this;
}

Profile& Profile::sphere(double centre_height, double sphere_radius, double end_radius, int segments) {
  const double start = points_.back().x, r2 = sphere_radius * sphere_radius;
  const double below = std::sqrt(r2 - start * start), above = std::sqrt(r2 - end_radius * end_radius);
  if (height() < centre_height - below) line(start, centre_height - below);
  const double angle = elementary::atan2(below, start) + elementary::atan2(above, end_radius);
  return arc(end_radius, centre_height + above, elementary::tan(angle / 4), segments);
}

Ring circle(Solid& solid, double radius, double height, int segments) {
  Ring ring;
  for (int j = 0; j < segments; ++j) {
    const double angle = 2 * elementary::kPi * j / segments;
    ring.push_back(solid.add_point({radius * elementary::cos(angle), height, -radius * elementary::sin(angle)}));
  }
  return ring;
}

Ring lathe_onto(Solid& solid, const Profile& profile, int segments, const Ring& first) {
  const Outline& points = profile.points();
  const std::vector<int> groups = crease_groups(points, false);
  Ring before = first;
  if (before.empty() && points[0].x > 0) before = circle(solid, points[0].x, points[0].y, segments);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const int group = groups[i - 1];
    if (points[i].x == 0) {
      cap(solid, before, solid.add_point({0, points[i].y, 0}), group);
      return {};
    }
    Ring ring = circle(solid, points[i].x, points[i].y, segments);
    if (before.empty()) {
      cap_right(solid, ring, solid.add_point({0, points[0].y, 0}), group);
    } else {
      bridge(solid, before, ring, group);
    }
    before = std::move(ring);
  }
  return before;
}

Solid lathe(const Profile& profile, int segments) {
  Solid solid;
  lathe_onto(solid, profile, segments, {});
  return solid;
}

Solid sweep(const Outline& section, double from, double to, int segments) {
  Solid solid;
  const std::vector<int> groups = crease_groups(section, true);
  const std::size_t n = section.size();
  std::vector<Ring> rings;
  for (int k = 0; k <= segments; ++k) {
    const double angle = from + (to - from) * k / segments;
    const double c = elementary::cos(angle), s = elementary::sin(angle);
    Ring ring;
    for (const glm::dvec2& p : section) ring.push_back(solid.add_point({p.x * c, p.y, -p.x * s}));
    rings.push_back(std::move(ring));
  }
  for (int k = 0; k < segments; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      solid.add_quad(rings[k][i], rings[k + 1][i], rings[k + 1][j], rings[k][j], groups[i]);
    }
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    solid.add_triangle(rings[0][0], rings[0][i], rings[0][i + 1], 0);
    solid.add_triangle(rings[segments][0], rings[segments][i + 1], rings[segments][i], 0);
  }
  return solid;
}

}  // namespace facemap::generators
