#include "math/intersect.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "support/random.h"

namespace {

using facemap::DVector;
using facemap::intersect;
using facemap::RayHit;
using LocalTriangle = std::array<DVector, 3>;

constexpr LocalTriangle kTriangle{DVector(0, 0, 0), DVector(4, 0, 0), DVector(0, 2, 0)};

// Largest error of t, u, v in the tests below, relative to 1: coordinates up to 2^3, a determinant of at least
// 2^-3, a few dozen roundings of 2^-53 each.
constexpr double kRounding = 0x1p-40;

TEST(Intersect, TellsDistanceAndBarycentricCoordinates) {
  const auto hit = intersect({1, 0.5, 5}, {0, 0, -1}, kTriangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 5);
  EXPECT_EQ(hit->u, 0.25);
  EXPECT_EQ(hit->v, 0.25);
}

TEST(Intersect, HitsFromBothSides) {
  // As printed, eq. (7) divides by the absolute value and loses the second of these.
  EXPECT_TRUE(intersect({1, 0.5, 5}, {0, 0, -1}, kTriangle));
  const auto from_below = intersect({1, 0.5, -5}, {0, 0, 1}, kTriangle);
  ASSERT_TRUE(from_below);
  EXPECT_EQ(from_below->t, 5);
  EXPECT_EQ(from_below->u, 0.25);
  EXPECT_EQ(from_below->v, 0.25);
}

TEST(Intersect, EdgesAndVerticesAreInside) {
  for (const DVector& p : {DVector(0, 0, 1), DVector(4, 0, 1), DVector(0, 2, 1), DVector(2, 0, 1), DVector(2, 1, 1)}) {
    EXPECT_TRUE(intersect(p, {0, 0, -1}, kTriangle)) << p.x << ' ' << p.y;
  }
  EXPECT_FALSE(intersect({2, 1.0625, 1}, {0, 0, -1}, kTriangle));
  EXPECT_FALSE(intersect({-0.0625, 1, 1}, {0, 0, -1}, kTriangle));
  EXPECT_FALSE(intersect({1, -0.0625, 1}, {0, 0, -1}, kTriangle));
}

TEST(Intersect, HasNoHitBehindOrAtTheOrigin) {
  EXPECT_FALSE(intersect({1, 0.5, 5}, {0, 0, 1}, kTriangle));
  EXPECT_FALSE(intersect({1, 0.5, 0}, {0, 0, 1}, kTriangle));
}

TEST(Intersect, HasNoHitInThePlaneOrOnATriangleWithoutArea) {
  EXPECT_FALSE(intersect({-1, 0.5, 0}, {1, 0, 0}, kTriangle));
  EXPECT_FALSE(intersect({1, 0, 5}, {0, 0, -1}, {DVector(0, 0, 0), DVector(2, 0, 0), DVector(4, 0, 0)}));
  EXPECT_FALSE(intersect({1, 0, 5}, {0, 0, 0}, kTriangle));
}

TEST(Intersect, NotANumberIsNoHit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(intersect({nan, 0.5, 5}, {0, 0, -1}, kTriangle));
  EXPECT_FALSE(intersect({1, 0.5, 5}, {0, nan, -1}, kTriangle));
  EXPECT_FALSE(intersect({1, 0.5, 5}, {0, 0, -1}, {DVector(0, 0, nan), DVector(4, 0, 0), DVector(0, 2, 0)}));
}

TEST(Intersect, FindsTheCombinationThatTheRayWasAimedAt) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const LocalTriangle f{random.in_cube() * 4.0, random.in_cube() * 4.0, random.in_cube() * 4.0};
    const DVector origin = random.in_cube() * 4.0;
    double u = random.unit(), v = random.unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    if (u < kRounding || v < kRounding || u + v > 1 - kRounding) continue;
    const double t = random.between(0.5, 2.0);
    const DVector target = f[0] + u * (f[1] - f[0]) + v * (f[2] - f[0]);
    const DVector direction = (target - origin) / t;
    const double determinant = glm::dot(glm::cross(direction, f[2] - f[0]), f[1] - f[0]);
    if (std::fabs(determinant) < 0x1p-3) continue;
    const auto hit = intersect(origin, direction, f);
    ASSERT_TRUE(hit) << "case " << i;
    EXPECT_NEAR(hit->t, t, kRounding);
    EXPECT_NEAR(hit->u, u, kRounding);
    EXPECT_NEAR(hit->v, v, kRounding);
    // Eq. (4): the weights are those of V0, V1, V2 in this order.
    const DVector again = (1 - hit->u - hit->v) * f[0] + hit->u * f[1] + hit->v * f[2];
    EXPECT_LE(glm::length(again - (origin + hit->t * direction)), 16 * kRounding);
  }
}

}  // namespace
