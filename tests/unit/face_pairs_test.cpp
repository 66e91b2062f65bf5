#include "picture/face_pairs.h"

#include <gtest/gtest.h>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "support/random.h"

namespace {

using namespace facemap;

// Faces of a few coordinates each: many lie in one plane, share corners or edges.
Scene small_grid_scene(Random& random, int faces) {
  Mesh mesh;
  for (int i = 0; i < 3 * faces; ++i) {
    const int x = random.below(3), y = random.below(3), z = random.below(3);
    mesh.positions.push_back(Vector(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
  }
  for (int i = 0; i < faces; ++i) {
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return Scene(mesh);
}

TEST(FacePairs, AnswersAreThoseOfTheCornersHoweverOftenAsked) {
  Random random(0x5eed0305);
  const Scene scene = small_grid_scene(random, 120);
  const Vector light(0.5f, 7, 0.25f);
  FacePairs pairs(scene);
  Counters counters;
  int clear = 0;
  constexpr int kQuestions = 50000;  // more than three a pair, more pairs than are remembered
  for (int i = 0; i < kQuestions; ++i) {
    const auto F = static_cast<std::uint32_t>(random.below(120)), G = static_cast<std::uint32_t>(random.below(120));
    const int s = side(triangle_of(scene, G), light);
    const bool expected = !reaches_beyond(triangle_of(scene, F), triangle_of(scene, G), s);
    ASSERT_EQ(pairs.is_clear(F, G, s, counters), expected) << F << " behind " << G;
    clear += expected;
  }
  EXPECT_GT(clear, kQuestions / 10);
  EXPECT_LT(clear, kQuestions * 9 / 10);
  EXPECT_EQ(counters.by_double + counters.by_exact, static_cast<std::uint64_t>(clear));
}

TEST(FacePairs, AFaceInTheSamePlaneNeverBlocks) {
  Mesh mesh;
  mesh.positions = {Vector(0, 0, 0),     Vector(4, 0, 1), Vector(0, 4, 2),  // z = x / 4 + y / 2
                    Vector(1, 1, 0.75f), Vector(8, 0, 2), Vector(0, 8, 4),
                    Vector(0, 0, 1),     Vector(4, 0, 2), Vector(0, 4, 3)};  // one above
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  const Scene scene(mesh);
  const Vector light(0, 0, 9);
  FacePairs pairs(scene);
  Counters counters;
  const int sides[3] = {side(triangle_of(scene, 0), light), side(triangle_of(scene, 1), light),
                        side(triangle_of(scene, 2), light)};
  EXPECT_TRUE(pairs.is_clear(0, 1, sides[1], counters));
  EXPECT_TRUE(pairs.is_clear(1, 0, sides[0], counters));
  EXPECT_EQ(counters.by_exact, 2u);
  EXPECT_TRUE(pairs.is_clear(2, 0, sides[0], counters)) << "nearer to the light";
  EXPECT_FALSE(pairs.is_clear(0, 2, sides[2], counters)) << "behind";
}

}  // namespace
