// Given points and faces in doubles, many at a time, and points as whole numbers of steps: every instruction set gives
// the scalar's bits, and what is decided is what exact signs say.

#include "simd/given_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "math/exact_sign.h"
#include "simd/step_points.h"
#include "simd/target.h"
#include "support/random.h"

namespace {

using namespace facemap;

class GivenPairs : public testing::Test {
 protected:
  ~GivenPairs() override { simd::set_active_target(simd::supported_targets().back()); }
};

// Points and corners on a lattice, so that signs of 0 abound, or anywhere.
struct Input {
  std::vector<Vector> points, positions;
  std::vector<std::uint32_t> corners;
  std::vector<simd::GivenPair> pairs;
  Vector light;
};

Input make_input(Random& random, std::size_t pairs) {
  const bool is_lattice = random.chance(0.5);
  const double size = std::exp2(random.between(-140.0, 120.0));
  const auto place = [&] {
    if (is_lattice) return Vector(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3));
    return Vector(random.in_cube() * size);
  };
  Input input;
  input.light = place();
  for (int i = 0; i < 40; ++i) input.points.push_back(place());
  for (int i = 0; i < 60; ++i) input.positions.push_back(place());
  for (int i = 0; i < 3 * 50; ++i) input.corners.push_back(static_cast<std::uint32_t>(random.below(60)));
  for (std::size_t i = 0; i < pairs; ++i) {
    input.pairs.push_back({static_cast<std::uint32_t>(random.below(40)), static_cast<std::uint32_t>(random.below(50))});
  }
  return input;
}

std::vector<std::uint8_t> verdicts_of(const Input& input) {
  std::vector<std::uint8_t> verdicts(input.pairs.size(), 7);
  const Vector& L = input.light;
  simd::decide_pairs({&input.points[0].x, input.corners.data(), &input.positions[0].x, {L.x, L.y, L.z}},
                     input.pairs.data(), input.pairs.size(), verdicts.data());
  return verdicts;
}

TEST_F(GivenPairs, AreDecidedAsExactSignsSayAndTheSameOnEveryTarget) {
  Random random(0x91f3);
  std::size_t asked = 0, decided = 0, yes = 0;
  for (int round = 0; round < 400; ++round) {
    const Input input = make_input(random, static_cast<std::size_t>(random.between(0, 300)));
    simd::set_active_target(simd::Target::Scalar);
    const std::vector<std::uint8_t> expected = verdicts_of(input);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::uint32_t* corner = &input.corners[3 * input.pairs[i].face];
      const Triangle face{input.positions[corner[0]], input.positions[corner[1]], input.positions[corner[2]]};
      const bool truth =
          blocks(face, side(face, input.light), input.light, GivenPoint{input.points[input.pairs[i].point]});
      ASSERT_TRUE(expected[i] == 2 || (expected[i] == 1) == truth) << "round " << round << ", pair " << i;
      decided += expected[i] != 2;
      yes += expected[i] == 1;
    }
    asked += expected.size();
    for (const simd::Target target : simd::supported_targets()) {
      simd::set_active_target(target);
      ASSERT_TRUE(verdicts_of(input) == expected) << simd::name_of(target) << ", round " << round;
    }
  }
  std::printf("%zu pairs, %zu decided, %zu of them blocked\n", asked, decided, yes);
  EXPECT_GT(decided, asked / 2);
  EXPECT_GT(yes, asked / 50);
}

TEST_F(GivenPairs, PointsInPlanesAlongTheAxesAreDecided) {
  Input input;
  input.light = {0.3f, 0.7f, 5};
  input.positions = {{-1, -1, 0.1f}, {1, -1, 0.1f}, {0, 1, 0.1f}};
  input.corners = {0, 1, 2};
  input.points = {{0.01f, 0.02f, 0.1f}};
  input.pairs = {{0, 0}};
  for (const simd::Target target : simd::supported_targets()) {
    simd::set_active_target(target);
    EXPECT_EQ(verdicts_of(input)[0], 0) << simd::name_of(target);
  }
}

TEST_F(GivenPairs, StepsAndBoxesOfPointsAreTheirDefinition) {
  Random random(0x57e9);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vector> points(static_cast<std::size_t>(random.between(1, 70)));
    const DVector origin = random.in_cube();
    for (Vector& point : points) point = Vector(origin + random.in_cube() * 0.5);
    const bool is_finite = random.chance(0.8);
    if (!is_finite) points[static_cast<std::size_t>(random.below(static_cast<int>(points.size())))].y = HUGE_VALF;
    for (const simd::Target target : simd::supported_targets()) {
      simd::set_active_target(target);
      const simd::PointBox box = simd::box_of_points(&points[0].x, points.size());
      ASSERT_EQ(box.is_finite, is_finite) << simd::name_of(target) << ", round " << round;
      if (!is_finite) continue;
      std::vector<std::int32_t> steps[3];
      for (auto& of_axis : steps) of_axis.resize(points.size());
      constexpr double kPerStep = 0x1p28;
      simd::step_points(&points[0].x, points.size(), {{origin.x, origin.y, origin.z}, kPerStep}, steps[0].data(),
                        steps[1].data(), steps[2].data());
      for (int k = 0; k < 3; ++k) {
        float lower = points[0][k], upper = lower;
        for (std::size_t i = 0; i < points.size(); ++i) {
          ASSERT_EQ(steps[k][i], std::nearbyint((double{points[i][k]} - origin[k]) * kPerStep));
          lower = std::min(lower, points[i][k]);
          upper = std::max(upper, points[i][k]);
        }
        ASSERT_EQ(box.lower[k], lower);
        ASSERT_EQ(box.upper[k], upper);
      }
    }
  }
}

}  // namespace
