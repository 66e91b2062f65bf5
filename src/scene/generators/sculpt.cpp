#include "scene/generators/sculpt.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"

namespace facemap::generators {
namespace {

constexpr double kSmallestStep = 0.004, kFarthest = 8;
constexpr int kRelaxations = 12;
constexpr int kBisections = 16;

DVector direction(const NetRow& row, double turn) {
  const double forward = std::max(0.0, elementary::cos(turn));
  const double elevation = row.back_deg + forward * forward * (row.front_deg - row.back_deg);
  const double e = elevation * (elementary::kPi / 180), c = elementary::cos(e);
  return {c * elementary::sin(turn), elementary::sin(e), c * elementary::cos(turn)};
}

// Where the ray from a point inside first leaves the sculpture.
DVector first_exit(const Field& field, const DVector& from, const DVector& direction) {
  double inside = 0, t = 0;
  while (t < kFarthest) {
    const double depth = -field(from + t * direction);
    if (depth <= 0) break;
    inside = t;
    t += std::max(kSmallestStep, 0.7 * depth);
  }
  double outside = t;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (inside + outside) / 2;
    (field(from + middle * direction) < 0 ? inside : outside) = middle;
  }
  return from + inside * direction;
}

// The field's slope at a point, from four values at the corners of a small tetrahedron.
DVector slope(const Field& field, const DVector& p) {
  constexpr double h = 0.002;
  const DVector corners[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  DVector sum(0);
  for (const DVector& c : corners) sum += c * field(p + h * c);
  return sum / (4 * h);
}

// One step of smoothing: each point moves towards the middle of its four neighbours in the net, along the surface, and
// back onto it. Steep places, where rays are sparse, get their share of points.
void relax(Solid& solid, const Field& field, const std::vector<Ring>& net) {
  constexpr double kPull = 0.6;
  std::vector<DVector> moved_points = solid.points;
  for (std::size_t i = 1; i + 1 < net.size(); ++i) {
    const std::size_t n = net[i].size();
    for (std::size_t j = 0; j < n; ++j) {
      const std::vector<DVector>& at = solid.points;
      const DVector here = at[net[i][j]];
      const DVector middle =
          0.25 * (at[net[i - 1][j]] + at[net[i + 1][j]] + at[net[i][(j + 1) % n]] + at[net[i][(j + n - 1) % n]]);
      const DVector target = here + kPull * (middle - here), down = slope(field, target);
      const double steepness = dot(down, down);
      const double step = steepness > 0.05 ? field(target) / steepness : 0.0;
      moved_points[net[i][j]] = target - step * down;
    }
  }
  solid.points = std::move(moved_points);
}

}  // namespace

double ball(const DVector& p, const DVector& centre, double radius) { return length(p - centre) - radius; }

double ellipsoid(const DVector& p, const DVector& centre, const DVector& radii) {
  const DVector q = (p - centre) / radii;
  const double k0 = length(q), k1 = length(q / radii);
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

double limb(const DVector& p, const DVector& a, double radius_a, const DVector& b, double radius_b) {
  const DVector ab = b - a;
  const double t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
  return length(p - a - t * ab) - (radius_a + t * (radius_b - radius_a));
}

double joined(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double common(double a, double b, double k) { return -joined(-a, -b, k); }

double carved(double a, double tool, double k) { return common(a, -tool, k); }

Solid wrap(const Field& field, const std::vector<NetRow>& rows, const NetColumns& columns) {
  Solid solid;
  std::vector<Ring> net;
  for (const NetRow& row : rows) {
    Ring ring;
    for (double turn : columns)
      ring.push_back(solid.add_point(first_exit(field, {0, row.y, row.z}, direction(row, turn))));
    if (!net.empty()) bridge(solid, ring, net.back(), 1);
    net.push_back(std::move(ring));
  }
  cap(solid, net.front(), solid.add_point(first_exit(field, {0, rows.front().y, rows.front().z}, {0, 1, 0})), 1);
  cap_right(solid, net.back(), solid.add_point(first_exit(field, {0, rows.back().y, rows.back().z}, {0, -1, 0})), 1);
  for (int i = 0; i < kRelaxations; ++i) relax(solid, field, net);
  return solid;
}

}  // namespace facemap::generators
