#include "math/parallel_signs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "support/sign_inputs.h"

namespace {

using facemap::blocks;
using facemap::blocks_along;
using facemap::covers_along;
using facemap::DVector;
using facemap::GivenPoint;
using facemap::side;
using facemap::side_along;
using facemap::Triangle;
using facemap::TruePoint;
using facemap::Vector;
using sign_inputs::Inputs;
using sign_inputs::Kind;

const Vector kDown(0, 0, -1);
const Triangle kLid{Vector(0, 0, 1), Vector(1, 0, 1), Vector(0, 1, 1)};  // counter-clockwise from above

TEST(ParallelSigns, SideIsNegativeForAFaceTurnedTowardsTheLight) {
  EXPECT_EQ(side_along(kLid, kDown), -1);
  EXPECT_EQ(side_along(kLid, -kDown), 1);
  EXPECT_EQ(side_along({kLid[0], kLid[2], kLid[1]}, kDown), 1);
  EXPECT_EQ(side_along(kLid, Vector(3, -2, 0)), 0);
  EXPECT_EQ(side_along(kLid, Vector(3, -2, -0x1p-149f)), -1);
  EXPECT_EQ(side_along(kLid, Vector(0)), 0);
  EXPECT_EQ(side_along({kLid[0], kLid[0], kLid[1]}, kDown), 0);
}

TEST(ParallelSigns, RaysHitWhatIsStrictlyAhead) {
  const Vector over(0.25f, 0.25f, 5);
  EXPECT_TRUE(covers_along(kLid, -1, over, kDown).strictly_inside);
  EXPECT_TRUE(covers_along(kLid, -1, over, 1e-30f * kDown).strictly_inside);
  EXPECT_FALSE(covers_along(kLid, 1, over, -kDown).hit) << "behind";
  EXPECT_FALSE(covers_along(kLid, -1, {0.25f, 0.25f, 1}, kDown).hit) << "on the face";
  EXPECT_TRUE(covers_along(kLid, -1, {0.25f, 0.25f, std::nextafter(1.0f, 2.0f)}, kDown).hit);
  EXPECT_FALSE(covers_along(kLid, -1, {0.25f, 0.25f, std::nextafter(1.0f, 0.0f)}, kDown).hit);
  EXPECT_FALSE(covers_along(kLid, 0, over, kDown).hit) << "edge-on";
}

TEST(ParallelSigns, EdgesAndVerticesCountAsInside) {
  for (const Vector& O : {Vector(0, 0, 2), Vector(1, 0, 2), Vector(0, 1, 2), Vector(0.5f, 0.5f, 2)}) {
    EXPECT_TRUE(covers_along(kLid, -1, O, kDown).hit);
    EXPECT_FALSE(covers_along(kLid, -1, O, kDown).strictly_inside);
    EXPECT_TRUE(blocks_along(kLid, -1, kDown, GivenPoint{Vector(O.x, O.y, 0)}));
  }
  EXPECT_FALSE(covers_along(kLid, -1, {std::nextafter(0.5f, 1.0f), 0.5f, 2}, kDown).hit);
  EXPECT_FALSE(blocks_along(kLid, -1, kDown, GivenPoint{Vector(std::nextafter(0.5f, 1.0f), 0.5f, 0)}));
}

TEST(ParallelSigns, BlockerMustStandStrictlyBeforeThePoint) {
  EXPECT_TRUE(blocks_along(kLid, -1, kDown, GivenPoint{Vector(0.2f, 0.2f, 0)}));
  EXPECT_TRUE(blocks_along(kLid, -1, kDown, GivenPoint{Vector(0.2f, 0.2f, -1e38f)}));
  EXPECT_FALSE(blocks_along(kLid, -1, kDown, GivenPoint{Vector(0.2f, 0.2f, 1)})) << "on the plane";
  EXPECT_FALSE(blocks_along(kLid, -1, kDown, GivenPoint{Vector(0.2f, 0.2f, std::nextafter(1.0f, 2.0f))}));
  EXPECT_TRUE(blocks_along(kLid, -1, kDown, GivenPoint{Vector(0.2f, 0.2f, std::nextafter(1.0f, 0.0f))}));
  EXPECT_FALSE(blocks_along(kLid, 1, -kDown, GivenPoint{Vector(0.2f, 0.2f, 0)})) << "behind the point";
  EXPECT_FALSE(blocks_along(kLid, 0, Vector(1, 0, 0), GivenPoint{Vector(5, 0.2f, 1)})) << "edge-on";
}

TEST(ParallelSigns, AToleranceAndANamedFaceCount) {
  GivenPoint tolerant{Vector(0.2f, 0.2f, 0.5f)};
  tolerant.tolerance = 0.5f;
  EXPECT_FALSE(blocks_along(kLid, -1, kDown, tolerant)) << "exactly at the tolerance";
  tolerant.tolerance = 0.4999f;
  EXPECT_TRUE(blocks_along(kLid, -1, kDown, tolerant));
  const GivenPoint on_lid{Vector(0.25f, 0.25f, 0.999f), &kLid};
  EXPECT_FALSE(blocks_along(kLid, -1, kDown, on_lid)) << "its projection is on the plane";
}

TEST(ParallelSigns, TruePointIsNotRounded) {
  // The camera's ray meets the floor y = 0 at x = 1/3. The light comes along (3, -3, 0), past a wall's edge.
  const Triangle floor{Vector(-9, 0, -9), Vector(0, 0, 9), Vector(9, 0, -9)};
  const TruePoint p{Vector(0, 1, 0), Vector(1, -3, 0), floor, side(floor, Vector(0, 1, 0))};
  const Vector d(3, -3, 0);
  // Its edge's points have x + y from -1 at z = -4 to 1 at z = 2, hence 1/3 at z = 0.
  const Triangle wall{Vector(-5, 4, -4), Vector(-4, 5, 2), Vector(-9, -9, 0)};
  EXPECT_TRUE(blocks_along(wall, side_along(wall, d), d, p)) << "on its edge";
  Triangle lower = wall;
  lower[0].y = std::nextafter(4.0f, 0.0f);
  EXPECT_FALSE(blocks_along(lower, side_along(lower, d), d, p));
  lower[0].y = std::nextafter(4.0f, 5.0f);
  EXPECT_TRUE(blocks_along(lower, side_along(lower, d), d, p));
}

TEST(ParallelSigns, NeighboursLeaveNoGapBetweenThem) {
  // Each point of a fan's plane outside its rim is blocked by one face or more, whatever the light's direction.
  Inputs inputs(Kind::Close, 0x5eed0403);
  Random random(0x5eed0404);
  for (int round = 0; round < 2000; ++round) {
    const Vector hub = inputs.vector();
    const Vector rim[4] = {{-8, -8, 1}, {8, -8, 1}, {8, 8, 1}, {-8, 8, 1}};
    const Vector d = 0.25f * Vector(random.in_cube()) + kDown;
    // A point that the light reaches through a point of a spoke or of the hub, rounded.
    const float k = static_cast<float>(random.below(2) * random.unit());
    const Vector P = hub + k * (rim[random.below(4)] * 0.5f - hub) + 4.0f * d;
    int blocked = 0;
    for (int i = 0; i < 4; ++i) {
      const Triangle f{hub, rim[i], rim[(i + 1) % 4]};
      blocked += blocks_along(f, side_along(f, d), d, GivenPoint{P});
    }
    ASSERT_GE(blocked, 1) << "round " << round;
  }
}

// A light at P - t d gives what parallel light gives, from some t on: ties included.
TEST(ParallelSigns, AreWhatAFarLightSaysExactly) {
  Inputs inputs(Kind::Grid, 0x5eed0405);
  int blocked = 0;
  for (int i = 0; i < 220000; ++i) {
    const Triangle f = inputs.triangle(), other = inputs.triangle();
    const Triangle G{inputs.below(3) == 0 ? f[0] : other[0], inputs.below(3) == 0 ? f[1] : other[1], other[2]};
    const Vector d = inputs.vector(), P = inputs.below(3) == 0 ? f[2] : inputs.vector(), ray = inputs.vector();
    const int s_G = side_along(G, d);
    const Vector L = P - 4096.0f * d;  // |n . (a - P)| <= 384 for corners within 2 of the origin, |n . d| >= 1 or 0
    if (d == Vector(0)) continue;
    if (s_G != 0) {
      ASSERT_EQ(side(G, L), s_G) << "round " << i;
    }
    // Edge-on, side(G, L) need not be 0; but P is on the light's side of G's plane, or in it.
    const bool expected = blocks(G, side(G, L), L, GivenPoint{P});
    ASSERT_EQ(blocks_along(G, s_G, d, GivenPoint{P}), expected) << "round " << i;
    // The same point, seen by a camera on a face through it.
    const Triangle through{P, f[1], f[2]};
    const int slope = side_along(through, ray);
    if (slope != 0) {
      const TruePoint seen{P - ray, ray, through, slope};
      ASSERT_EQ(blocks_along(G, s_G, d, seen), expected) << "round " << i;
    }
    blocked += expected;
  }
  EXPECT_GT(blocked, 2000);
}

// How far the least of a predicate's signs is from a tie, as a part of what its factors could make it.
double distance_from_tie(const Triangle& G, const Vector& P, const Vector& d) {
  const auto determinant = [](const DVector& a, const DVector& b, const DVector& c) {
    return std::fabs(glm::dot(glm::cross(a, b), c)) / (1e-300 + glm::length(a) * glm::length(b) * glm::length(c));
  };
  const DVector a = DVector(G[0]) - DVector(P), b = DVector(G[1]) - DVector(P), c = DVector(G[2]) - DVector(P), D(d);
  return std::min({determinant(a, b, D), determinant(b, c, D), determinant(c, a, D), determinant(b - a, c - a, D),
                   determinant(b - a, c - a, a)});
}

TEST(ParallelSigns, ALightFarAwayAgreesWhereNothingIsNearATie) {
  // The light is rounded to 2^-24 of its distance, as its direction is; a point and corners within 2 of the origin are
  // 2^-59 of it.
  constexpr double kNearTie = 0x1p-20;  // of a product of lengths
  Inputs inputs(Kind::Plain, 0x5eed0406);
  int asked = 0, blocked = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Triangle f = inputs.triangle(), G = inputs.neighbour(f);
    const Vector d = inputs.near(f) - inputs.near(G), P = inputs.near(f), L = P - 0x1p60f * d;
    if (!(distance_from_tie(G, P, d) > kNearTie)) continue;
    ASSERT_EQ(side(G, L), side_along(G, d)) << "round " << i;
    const bool expected = blocks(G, side(G, L), L, GivenPoint{P});
    ASSERT_EQ(blocks_along(G, side_along(G, d), d, GivenPoint{P}), expected) << "round " << i;
    ++asked;
    blocked += expected;
  }
  EXPECT_GT(asked, 200000);
  EXPECT_GT(blocked, 2000);
}

}  // namespace
