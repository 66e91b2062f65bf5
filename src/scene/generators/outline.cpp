#include "scene/generators/outline.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "math/elementary.h"

namespace facemap::generators {
namespace {

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_crease(const glm::dvec2& before, const glm::dvec2& here, const glm::dvec2& after) {
  return dot(normalize(here - before), normalize(after - here)) < kCreaseAngleCosine;
}

// How good it is to cut off the corner at position `i` of `left`: the triangle's area over its longest side's square,
// or -1 if the corner is not convex or holds another one.
double ear_quality(const Outline& polygon, const std::vector<std::uint32_t>& left, std::size_t i) {
  const std::size_t n = left.size();
  const glm::dvec2 &a = polygon[left[(i + n - 1) % n]], &b = polygon[left[i]], &c = polygon[left[(i + 1) % n]];
  const double area = turn(a, b, c);
  if (area <= 0) return -1;
  for (std::uint32_t k : left) {
    const glm::dvec2& p = polygon[k];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return -1;
  }
  return area / std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
}

glm::dvec2 catmull_rom(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d, double t) {
  return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

}  // namespace

std::vector<int> crease_groups(const Outline& outline, bool closed) {
  const std::size_t n = outline.size(), edges = closed ? n : n - 1;
  std::vector<int> stretch(edges, 0);
  for (std::size_t i = 1; i < edges; ++i) {
    stretch[i] = stretch[i - 1] + is_crease(outline[i - 1], outline[i], outline[(i + 1) % n]);
  }
  const int last = stretch.back();
  const bool joined = closed && !is_crease(outline[n - 1], outline[0], outline[1]);
  std::vector<int> groups(edges);
  for (std::size_t i = 0; i < edges; ++i) {
    const int k = joined && stretch[i] == last ? 0 : stretch[i];
    const bool odd_one = closed && k > 0 && k == last - joined && k % 2 == 0;
    groups[i] = odd_one ? 3 : 1 + k % 2;
  }
  return groups;
}

std::vector<Corners> triangulate(const Outline& polygon) {
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<double> quality(left.size());
  const auto judge_all = [&] {
    for (std::size_t i = 0; i < left.size(); ++i) quality[i] = ear_quality(polygon, left, i);
  };
  judge_all();
  std::vector<Corners> triangles;
  while (left.size() > 3) {
    auto best = std::max_element(quality.begin(), quality.end());
    if (*best < 0) {  // the last cut may have freed an ear elsewhere
      judge_all();
      best = std::max_element(quality.begin(), quality.end());
    }
    const std::size_t n = left.size(), i = static_cast<std::size_t>(best - quality.begin());
    triangles.push_back({left[(i + n - 1) % n], left[i], left[(i + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    quality.erase(best);
    for (std::size_t k : {(i + n - 2) % (n - 1), i % (n - 1)}) quality[k] = ear_quality(polygon, left, k);
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

Outline inset(const Outline& polygon, double distance) {
  const std::size_t n = polygon.size();
  Outline result(n);
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 d0 = normalize(polygon[i] - polygon[(i + n - 1) % n]);
    const glm::dvec2 d1 = normalize(polygon[(i + 1) % n] - polygon[i]);
    const glm::dvec2 left = glm::dvec2(-d0.y, d0.x) + glm::dvec2(-d1.y, d1.x);
    result[i] = polygon[i] + left * (2 * distance / dot(left, left));
  }
  return result;
}

Outline smooth_curve(const Outline& knots, int segments, bool closed) {
  const auto n = static_cast<std::ptrdiff_t>(knots.size());
  const auto knot = [&](std::ptrdiff_t i) -> glm::dvec2 {
    if (closed) return knots[(i + n) % n];
    if (i < 0) return 2.0 * knots[0] - knots[1];
    if (i >= n) return 2.0 * knots[n - 1] - knots[n - 2];
    return knots[i];
  };
  Outline points;
  const std::ptrdiff_t spans = closed ? n : n - 1;
  for (std::ptrdiff_t i = 0; i < spans; ++i) {
    for (int k = 0; k < segments; ++k) {
      points.push_back(catmull_rom(knot(i - 1), knot(i), knot(i + 1), knot(i + 2), double(k) / segments));
    }
  }
  if (!closed) points.push_back(knots.back());
  return points;
}

Outline rounded_rectangle(glm::dvec2 lower, glm::dvec2 upper, double radius, int segments) {
  const glm::dvec2 centres[4] = {{upper.x - radius, upper.y - radius},
                                 {lower.x + radius, upper.y - radius},
                                 {lower.x + radius, lower.y + radius},
                                 {upper.x - radius, lower.y + radius}};
  Outline points;
  for (int corner = 0; corner < 4; ++corner) {
    for (int k = 0; k <= segments; ++k) {
      const double angle = elementary::kPi / 2 * (corner + double(k) / segments);
      points.push_back(centres[corner] + radius * glm::dvec2(elementary::cos(angle), elementary::sin(angle)));
    }
  }
  return points;
}

}  // namespace facemap::generators
