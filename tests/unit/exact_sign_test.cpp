#include "math/exact_sign.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace {

using facemap::blocks;
using facemap::compare_depth;
using facemap::Counters;
using facemap::covers;
using facemap::GivenPoint;
using facemap::offset_from;
using facemap::ray_parameter;
using facemap::side;
using facemap::Triangle;
using facemap::TruePoint;
using facemap::Vector;

const Triangle kFacing{Vector(0, 0, -1), Vector(1, 0, -1), Vector(0, 1, -1)};  // counter-clockwise from the origin

TEST(ExactSign, SideIsNegativeForAFaceTurnedTowardsTheOrigin) {
  EXPECT_EQ(side(kFacing, Vector(0)), -1);
  EXPECT_EQ(side({kFacing[0], kFacing[2], kFacing[1]}, Vector(0)), 1);
  EXPECT_EQ(side(kFacing, Vector(5, 7, -1)), 0);
}

TEST(ExactSign, SideHoldsAtTheEndsOfTheFloatRange) {
  for (const float scale : {1e-30f, 1e-38f, 1e30f, 1e38f}) {
    Triangle f = kFacing;
    for (Vector& v : f) v *= scale;
    EXPECT_EQ(side(f, Vector(0)), -1) << scale;
    EXPECT_EQ(side(f, Vector(0.25f * scale, 0, -scale)), 0) << scale;
    EXPECT_EQ(side(f, Vector(0, 0, std::nextafter(-scale, 0.0f))), -1) << scale;
    EXPECT_EQ(side(f, Vector(0, 0, std::nextafter(-scale, -INFINITY))), 1) << scale;
  }
}

TEST(ExactSign, MixedMagnitudesAreDecidedExactly) {
  // a + b + c with |a| = 1e30 and |c| = 1e-30: no double holds both.
  const Triangle f{Vector(1e30f, 0, 0), Vector(1e30f, 1e-30f, 0), Vector(1e30f, 0, 1e-30f)};
  EXPECT_EQ(side(f, Vector(0)), 1);
  EXPECT_EQ(side(f, Vector(1e30f, 1, 1)), 0);
  EXPECT_EQ(side(f, Vector(std::nextafter(1e30f, INFINITY), 0, 0)), -1);
}

TEST(ExactSign, ADifferenceThatNoDoubleHoldsDecidesASide) {
  const float big = 0x1p60f;                                                                     // big - 1 has 60 bits
  const Triangle f{Vector(big, -big, 0), Vector(big, -big, big), Vector(2 * big, -2 * big, 0)};  // in x + y = 0
  EXPECT_EQ(side(f, Vector(1, 0, 0)), -1);
  EXPECT_EQ(side(f, Vector(0)), 0);
  EXPECT_EQ(side(f, Vector(-1, 0, 0)), 1);
}

TEST(ExactSign, EdgesAndVerticesCountAsInside) {
  const int s = side(kFacing, Vector(0));
  EXPECT_TRUE(covers(kFacing, s, Vector(0), Vector(0.25f, 0.25f, -1)).strictly_inside);
  for (const Vector& d : {Vector(0, 0, -1), Vector(1, 0, -1), Vector(0, 1, -1), Vector(0.5f, 0.5f, -1)}) {
    EXPECT_TRUE(covers(kFacing, s, Vector(0), d).hit);
    EXPECT_FALSE(covers(kFacing, s, Vector(0), d).strictly_inside);
  }
  EXPECT_FALSE(covers(kFacing, s, Vector(0), Vector(std::nextafter(0.5f, 1.0f), 0.5f, -1)).hit);
  EXPECT_FALSE(covers(kFacing, s, Vector(0), Vector(-0.25f, -0.25f, 1)).hit) << "behind the origin";
  EXPECT_FALSE(covers(kFacing, s, Vector(0), Vector(0)).hit);
  EXPECT_FALSE(covers(kFacing, 0, Vector(0), Vector(0, 0, -1)).hit);
}

TEST(ExactSign, DepthsOfCoplanarFacesAreEqual) {
  const Triangle moved{Vector(0, 0, -1), Vector(3, 0, -1), Vector(0, 3, -1)};
  const Vector d(0.1f, 0.2f, -0.7f);
  EXPECT_EQ(compare_depth(kFacing, -1, moved, -1, Vector(0), d), 0);
  Triangle farther = moved;
  farther[0].z = std::nextafter(-1.0f, -2.0f);
  EXPECT_EQ(compare_depth(kFacing, -1, farther, -1, Vector(0), d), -1);
  EXPECT_EQ(compare_depth(farther, -1, kFacing, -1, Vector(0), d), 1);
}

TEST(ExactSign, DepthsTowardsAPointThatNoFloatDirectionLeadsTo) {
  // P - O = (2^30 - 2^-30, y, 0) has 60 bits. The planes x + k y = 2^29 are met at the same place if y is 0; for a
  // hair more the steeper one is met first.
  const auto wall = [](float k) {
    return Triangle{Vector(0x1p29f - k * 0x1p28f, 0x1p28f, -0x1p28f), Vector(0x1p29f, 0, 0x1p29f),
                    Vector(0x1p29f + k * 0x1p28f, -0x1p28f, -0x1p28f)};
  };
  const Vector O(0x1p-30f, 0, 0);
  const Triangle flat = wall(0), steep = wall(1);
  const int s1 = side(flat, O), s2 = side(steep, O);
  for (const float y : {0.0f, 0x1p-60f, -0x1p-60f}) {
    const Vector P(0x1p30f, y, 0);
    ASSERT_TRUE(blocks(flat, s1, O, GivenPoint{P}));
    ASSERT_TRUE(blocks(steep, s2, O, GivenPoint{P}));
    const int expected = y > 0 ? 1 : y < 0 ? -1 : 0;
    EXPECT_EQ(facemap::compare_depth_towards(flat, s1, steep, s2, O, P), expected) << y;
    EXPECT_EQ(facemap::compare_depth_towards(steep, s2, flat, s1, O, P), -expected) << y;
    const facemap::Tracked t = facemap::segment_parameter(flat, O, P);
    EXPECT_LE(std::fabs(t.value - 0.5), t.error * 2 + 0x1p-53);
  }
}

TEST(ExactSign, BlockerMustStandStrictlyBeforeThePoint) {
  const Vector L(0);
  EXPECT_TRUE(blocks(kFacing, -1, L, GivenPoint{Vector(0.2f, 0.2f, -2)}));
  EXPECT_FALSE(blocks(kFacing, -1, L, GivenPoint{Vector(0.2f, 0.2f, -1)})) << "on the plane";
  EXPECT_FALSE(blocks(kFacing, -1, L, GivenPoint{Vector(0.2f, 0.2f, std::nextafter(-1.0f, 0.0f))}));
  EXPECT_TRUE(blocks(kFacing, -1, L, GivenPoint{Vector(0.2f, 0.2f, std::nextafter(-1.0f, -2.0f))}));
  EXPECT_FALSE(blocks(kFacing, -1, L, GivenPoint{Vector(0, 0, 2)})) << "on the other side of the light";
  GivenPoint tolerant{Vector(0.2f, 0.2f, -1.5f)};
  tolerant.tolerance = 0.5f;
  EXPECT_FALSE(blocks(kFacing, -1, L, tolerant)) << "exactly at the tolerance";
  tolerant.tolerance = 0.4999f;
  EXPECT_TRUE(blocks(kFacing, -1, L, tolerant));
}

TEST(ExactSign, TruePointIsNotRounded) {
  // The camera's ray meets the floor y = 0 at x = 1/3; a wall whose plane passes through exactly that point
  // does not block, one a hair before it does.
  const Triangle floor{Vector(-9, 0, -9), Vector(0, 0, 9), Vector(9, 0, -9)};
  const TruePoint p{Vector(0, 1, 0), Vector(1, -3, 0), floor, side(floor, Vector(0, 1, 0))};
  const Vector L(2, 1, 0);
  Counters counters;
  // The plane through (1/3, 0, 0) and (1, 2, z): 3 x = y + 1.
  const Triangle wall{Vector(1, 2, -5), Vector(0, -1, 0), Vector(1, 2, 5)};
  ASSERT_NE(side(wall, L), 0);
  EXPECT_FALSE(blocks(wall, side(wall, L), L, p, &counters));
  EXPECT_EQ(counters.by_exact + counters.by_double, 1u);
  Triangle nearer = wall;
  nearer[1].x = std::nextafter(0.0f, 1.0f);
  EXPECT_TRUE(blocks(nearer, side(nearer, L), L, p, &counters));
  nearer[1].x = std::nextafter(0.0f, -1.0f);
  EXPECT_FALSE(blocks(nearer, side(nearer, L), L, p, &counters));
  EXPECT_GE(counters.by_exact, 1u);
}

TEST(ExactSign, OffsetsAreSharp) {
  const Triangle floor{Vector(-9, 0, -9), Vector(0, 0, 9), Vector(9, 0, -9)};
  const TruePoint p{Vector(0, 1, 0), Vector(1, -3, 0), floor, -1};
  const facemap::DVector D = offset_from(Vector(2, 1, 0), p, ray_parameter(p));
  EXPECT_NEAR(D.x, 1.0 / 3 - 2, 1e-15);
  EXPECT_EQ(D.y, -1);
  // Seen from 1e6 away at a grazing angle, and asked from next to the point.
  const TruePoint grazing{Vector(-1e6f, 1, 0), Vector(1e6f, -1, 0), floor, -1};
  const facemap::DVector E = offset_from(Vector(1e-3f, 0, 0), grazing, ray_parameter(grazing));
  EXPECT_NEAR(E.x, -double(1e-3f), 1e-15);
  EXPECT_NEAR(E.y, 0, 1e-15);
}

TEST(ExactSign, OffsetsAreSharpHoweverGrazingTheRay) {
  // Rays along a face's plane, up to rounding, that meet it exactly in its second corner: t is 1.
  Random random(0x5eed0070);
  const auto coordinate = [&] { return 1 + static_cast<float>(random.below(1 << 23)) * 0x1p-23f; };
  const auto vertex = [&] {
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return Vector(x, y, z);
  };
  int asked = 0, by_exact = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector a = vertex(), b = vertex(), c = vertex();
    const Triangle f{b, a, c};
    const facemap::DVector A(a), u = facemap::DVector(b) - A, v = facemap::DVector(c) - A;
    const double p = random.between(-0.5, 0.5), q = random.between(-0.5, 0.5);
    const Vector K(A + p * u + q * v), d = a - K;
    const int s = side(f, K);
    if (s == 0 || facemap::DVector(d) != A - facemap::DVector(K)) continue;
    const TruePoint point{K, d, f, s};
    const facemap::Tracked t = ray_parameter(point);
    ++asked;
    by_exact += t.error > 0x1p-40;
    ASSERT_LE(std::fabs(t.value - 1), t.error * (1 + 0x1p-40));
    ASSERT_LE(std::fabs(sharp_ray_parameter(point, t) - 1), 0x1p-30);
    const Vector L(A + std::pow(2.0, random.between(-12.0, 0.0)) * random.direction());
    const facemap::DVector expected = A - facemap::DVector(L), error = offset_from(L, point, t) - expected;
    ASSERT_LE(error.x * error.x + error.y * error.y + error.z * error.z,
              facemap::kDirectionError * facemap::kDirectionError *
                  (expected.x * expected.x + expected.y * expected.y + expected.z * expected.z));
  }
  EXPECT_GT(asked, 2000);
  EXPECT_GT(by_exact, 1000);
}

TEST(ExactSign, NamedFaceProjectsThePoint) {
  const GivenPoint off{Vector(0.25f, 0.25f, -1.001f), &kFacing};
  const facemap::DVector D = offset_from(Vector(0), off);
  EXPECT_EQ(D.z, -1);
  EXPECT_FALSE(blocks(kFacing, -1, Vector(0), off)) << "its projection is on the plane";
}

TEST(ExactSign, DegenerateFacesAreFoundExactly) {
  EXPECT_TRUE(facemap::is_degenerate(Vector(1), Vector(1), Vector(2)));
  EXPECT_TRUE(facemap::is_degenerate(Vector(0), Vector(1, 2, 3), Vector(3, 6, 9)));
  EXPECT_FALSE(facemap::is_degenerate(Vector(0), Vector(1, 2, 3), Vector(3, 6, std::nextafter(9.0f, 10.0f))));
  EXPECT_TRUE(facemap::is_degenerate(Vector(0.1f), Vector(0.3f), Vector(0.7f)));
}

}  // namespace
