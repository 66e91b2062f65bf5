#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "map/cover.h"
#include "math/elementary.h"
#include "support/random.h"

namespace {

using facemap::bulge;
using facemap::DVector;
using facemap::elementary::kPi;

// The surface projection in radians, by the standard library: x, y and the angle from the axis.
DVector image(const DVector& d) {
  const double across = std::hypot(d.x, d.y), beta = std::atan2(across, d.z);
  return across == 0 ? DVector(0, 0, beta) : DVector(beta * d.x / across, beta * d.y / across, beta);
}

double distance_to_chord(const DVector& p, const DVector& a, const DVector& b) {
  const glm::dvec2 along(b.x - a.x, b.y - a.y), offset(p.x - a.x, p.y - a.y);
  const double share = glm::clamp(glm::dot(offset, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(offset - share * along);
}

// How far random arcs up to `longest` radians, wholly within `beta` of the axis, leave their chords: the largest
// share of the bound.
double largest_share(double longest, double beta, int arcs, Random& random) {
  constexpr int kSteps = 32;
  double largest = 0;
  for (int i = 0; i < arcs; ++i) {
    const DVector start = random.direction();
    DVector tangent = random.direction();
    tangent = glm::normalize(tangent - glm::dot(tangent, start) * start);
    const double angle = random.between(1e-3, longest);
    DVector points[kSteps + 1];
    double farthest = 0;
    for (int k = 0; k <= kSteps; ++k) {
      const double s = angle * k / kSteps;
      points[k] = image(std::cos(s) * start + std::sin(s) * tangent);
      farthest = std::max(farthest, points[k].z);
    }
    if (farthest > beta) continue;
    for (const DVector& p : points) {
      largest = std::max(largest, distance_to_chord(p, points[0], points[kSteps]) / bulge(angle, farthest));
    }
  }
  return largest;
}

TEST(Bulge, NoGreatCircleLeavesItsChordByMore) {
  Random random(61);
  // 2.6 radians is where boxes end; the bound holds beyond, too.
  for (const double beta : {0.05, 0.5, kPi / 2, 2.0, 2.6, 3.1}) {
    const double share = largest_share(0.5, beta, 20000, random);
    std::printf("arcs within %.2f rad of the axis: at most %.5f of the bound\n", beta, share);
    EXPECT_LE(share, 1) << beta;
  }
}

TEST(Bulge, IsReached) {
  // A bound that is twice too large would cost texels; arcs across the radius at 90 degrees come close to it.
  Random random(62);
  EXPECT_GT(largest_share(0.02, 2.0, 20000, random), 0.99);
}

TEST(Bulge, GrowsWithTheAngleFromTheAxis) {
  // From one formula to the other, at 0.1 radians, it falls by a hundredth: the first is rounded up.
  for (double beta = 0.1; beta < 3.1; beta += 1e-3) EXPECT_LE(bulge(0.1, beta), bulge(0.1, beta + 1e-3)) << beta;
}

}  // namespace
