#include "scene/closed_winding.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "support/random.h"

namespace facemap {
namespace {

// From the origin away from this centre, the first direction is kAlong.
constexpr DVector kCentre(-1, -1, -1);
constexpr Vector kAlong(1021, 577, 769);
constexpr Vector kAcross(577, -1021, 0), kUp(0, 769, -577);  // both at right angles to kAlong

WindingRay ray() { return {Vector(0), kCentre, 0}; }

std::optional<int> crossing(Triangle face) {
  const std::optional<int> there = ray().crossing(face);
  std::swap(face[0], face[1]);
  const std::optional<int> back = ray().crossing(face);
  EXPECT_EQ(there.has_value(), back.has_value());
  EXPECT_EQ(there.value_or(0), -back.value_or(0));  // turned round, it counts the other way
  return there;
}

TEST(WindingRay, CountsFacesThatItMeetsInside) {
  const Triangle face = {kAlong + kAcross, kAlong + kUp, kAlong - kAcross - kUp};
  EXPECT_EQ(crossing(face).value_or(0), side(face, Vector(0)));
  EXPECT_NE(crossing(face).value_or(0), 0);
  EXPECT_EQ(crossing({-face[0], -face[1], -face[2]}), 0);  // behind
  EXPECT_EQ(crossing({face[0], face[1], face[0] + kUp}), 0);
}

TEST(WindingRay, KnowsNothingOfEdgesAndVertices) {
  EXPECT_EQ(crossing({kAlong, kAlong + kAcross, kAlong + kUp}), std::nullopt);
  EXPECT_EQ(crossing({kAlong + kAcross, kAlong - kAcross, kAlong + kUp}), std::nullopt);
  EXPECT_EQ(crossing({-kAlong, -kAlong + kAcross, -kAlong + kUp}), 0);  // on the line, but behind
}

TEST(WindingRay, KnowsNothingOfFacesThatHoldItOrItsStart) {
  EXPECT_EQ(crossing({kAlong, kAlong + kAlong, kAcross}), std::nullopt);             // in its plane, meets it
  EXPECT_EQ(crossing({-kAlong, kAlong + kAcross, kAlong - kAcross}), std::nullopt);  // from the start on
  EXPECT_EQ(crossing({kAcross, kUp, -kAcross - kUp}), std::nullopt);                 // starts inside
  EXPECT_EQ(crossing({kAcross, -kAcross, kUp}), std::nullopt);                       // on an edge
  EXPECT_EQ(crossing({Vector(0), kAcross, kUp}), std::nullopt);                      // on a vertex
  EXPECT_EQ(crossing({kAcross, kUp, kAcross + kUp}), 0);                             // beside it in its plane
}

// Coordinates are integers below 2^11, so that products of three are exact in doubles.
TEST(WindingRay, TestsAheadLoseNoFace) {
  Random random(0x5eed0033);
  const auto triple = [](const DVector& a, const DVector& b, const DVector& c) {
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  };
  int met = 0;
  for (int i = 0; i < 200'000; ++i) {
    Triangle face;
    const Vector middle = random.chance(0.5) ? kAlong : Vector(0);
    for (Vector& v : face) {
      for (int axis = 0; axis < 3; ++axis) v[axis] = middle[axis] + static_cast<float>(random.between(-900, 900));
    }
    const DVector a(face[0]), b(face[1]), c(face[2]), d(kAlong);
    const double x = triple(a, b, d), y = triple(b, c, d), z = triple(c, a, d), whole = triple(a, b, c);
    const bool is_strict = (x > 0 && y > 0 && z > 0 && whole > 0) || (x < 0 && y < 0 && z < 0 && whole < 0);
    if (x == 0 || y == 0 || z == 0 || whole == 0) continue;
    ASSERT_EQ(ray().crossing(face).value_or(2) != 0, is_strict) << i;
    met += is_strict;
  }
  EXPECT_GT(met, 5'000);
}

}  // namespace
}  // namespace facemap
