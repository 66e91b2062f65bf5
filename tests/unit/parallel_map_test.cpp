#include <facemap/error.h>
#include <facemap/parallel_light.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "map/face_planes.h"
#include "map/parallel_frame.h"
#include "math/dvector.h"
#include "math/parallel_signs.h"
#include "support/scenes.h"

namespace {

using namespace facemap;

// Any, along an axis, or along a face, which it then sees edge-on.
Vector make_direction(const Scene& scene, Random& random) {
  Vector d(random.direction());
  const int choice = random.below(4);
  if (choice == 0) {
    d = Vector(0);
    d[random.below(3)] = random.chance(0.5) ? 1.0f : -1.0f;
  }
  if (choice == 1) {
    const Triangle f = triangle_of(scene, scene.kept_faces()[0]);
    d = f[1] - f[0];
  }
  const float sum = std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z);
  return sum > 0 && std::isfinite(sum) ? d : Vector(1, 2, 3);
}

// Asks lines through points of faces: each face that the exact predicate says is met must be in the list of the texel,
// unless it begins behind the cut, of which is_blocked speaks.
TEST(ParallelMap, ListsHoldEveryFaceThatALineMeets) {
  Random random(0x5eed0430);
  int met = 0, largest = 0;
  for (int round = 0; round < 300; ++round) {
    const test_scenes::TestScene test = test_scenes::make_any_scene(random, 40);
    const Scene scene(test.mesh);
    if (scene.kept_faces().empty()) continue;
    const Vector d = make_direction(scene, random);
    ParallelMap::Options options;
    options.texels = random.between(1, 80);
    options.keep_all = true;
    const ParallelMap map(scene, d, options);
    largest = std::max({largest, map.width(), map.height()});
    const ParallelFrame frame(scene, d, options.texels);
    for (int i = 0; i < 40; ++i) {
      const auto pick = static_cast<std::size_t>(random.below(static_cast<int>(scene.kept_faces().size())));
      const Triangle face = triangle_of(scene, scene.kept_faces()[pick]);
      const double p = i % 3 == 0 ? 0 : random.unit(), q = i % 2 == 0 ? 0 : (1 - p) * random.unit();
      const Vector P(DVector(face[0]) + p * (DVector(face[1]) - DVector(face[0])) +
                     q * (DVector(face[2]) - DVector(face[0])));
      const Vector O(DVector(P) - 3 * frame.extent() / length(DVector(d)) * DVector(d));
      if (!std::isfinite(O.x + O.y + O.z)) continue;
      const auto found = frame.find(frame.place(DVector(O) - DVector(frame.origin()), ParallelFrame::kSharpError));
      std::vector<std::uint32_t> list;
      if (found.where == ParallelFrame::Where::Texel) {
        const auto width = static_cast<std::uint32_t>(map.width());
        const auto ids = map.faces_at(static_cast<int>(found.texel % width), static_cast<int>(found.texel / width));
        list.assign(ids.begin(), ids.end());
      }
      ASSERT_NE(found.where, ParallelFrame::Where::Anywhere);
      for (const std::uint32_t id : scene.kept_faces()) {
        const Triangle other = triangle_of(scene, id);
        if (!covers_along(other, side_along(other, d), O, d).hit) continue;
        ++met;
        ASSERT_NE(std::find(list.begin(), list.end(), id), list.end()) << test.name << " face " << id;
      }
    }
  }
  EXPECT_GT(met, 5000);
  EXPECT_GT(largest, 100);
}

Mesh two_sheets() {
  Mesh mesh;
  test_scenes::add_triangle(mesh, {-9, -9, 0}, {9, -9, 0}, {0, 12, 0});
  test_scenes::add_triangle(mesh, {-9, -9, -1}, {9, -9, -1}, {0, 12, -1});
  return mesh;
}

TEST(ParallelMap, RefusesDirectionsAndSizesThatAreNone) {
  const Scene scene(two_sheets());
  EXPECT_THROW(ParallelMap(scene, Vector(0)), Error);
  EXPECT_THROW(ParallelMap(scene, {0, std::numeric_limits<float>::quiet_NaN(), 1}), Error);
  EXPECT_THROW(ParallelMap(scene, {0, std::numeric_limits<float>::infinity(), 1}), Error);
  ParallelMap::Options options;
  options.texels = -1;
  EXPECT_THROW(ParallelMap(scene, {0, 0, -1}, options), Error);
  options.texels = 1 << 20;
  EXPECT_THROW(ParallelMap(scene, {0, 0, -1}, options), Error);
}

TEST(ParallelMap, FacesBehindACoverAreListedOnlyIfAllAreKept) {
  const Scene scene(two_sheets());
  ParallelMap::Options options;
  const ParallelMap some(scene, {0, 0, -1}, options);
  options.keep_all = true;
  const ParallelMap all(scene, {0, 0, -1}, options);
  EXPECT_EQ(all.faces_at(all.width() / 2, all.height() / 2).size(), 2u);
  EXPECT_EQ(some.faces_at(some.width() / 2, some.height() / 2).size(), 1u);
  EXPECT_LT(some.entry_count(), all.entry_count());
  // A ray that starts between the two sees the far one with either.
  for (const ParallelMap* map : {&some, &all}) {
    EXPECT_EQ(map->nearest({0, 0, 5}).face, 0);
    EXPECT_EQ(map->nearest({0, 0, -0.5f}).face, 1);
    EXPECT_EQ(map->nearest({0, 0, -0.5f}).depth, 0.5f);
    EXPECT_FALSE(map->nearest({0, 0, -1}));
    EXPECT_FALSE(map->nearest({20, 0, 5}));
    EXPECT_FALSE(map->nearest({std::numeric_limits<float>::infinity(), 0, 5}));
  }
}

TEST(ParallelMap, ASceneSeenEdgeOnMeetsNothing) {
  const Scene scene(two_sheets());
  const ParallelLight light(scene, {1, 0, 0});
  EXPECT_EQ(light.side(0), 0);
  EXPECT_EQ(light.entry_count(), 0u);
  EXPECT_TRUE(light.get_lighten_up(Vector(3, 0, 0)));
  EXPECT_FALSE(light.nearest({-20, 0, 0}));
}

TEST(ParallelLight, LightsWhatNothingHides) {
  const Scene scene(two_sheets());
  const ParallelLight light(scene, {0, 0, -2});
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, 1)));
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, 0))) << "on the face's plane";
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, -1)));
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, -1e30f)));
  EXPECT_TRUE(light.get_lighten_up(Vector(40, 0, -1e30f)));
  ParallelLight::On on;
  on.tolerance = 0.5f;
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, -0.25f), on)) << "within the tolerance of the only face before it";
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, -0.75f), on));
  on.tolerance = 3;
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, -2.5f), on)) << "within the tolerance of both";
  on.tolerance = 0;
  on.face = 1;
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, 7), on)) << "its projection onto the far sheet is asked";
  on.face = 0;
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, 7), on));
}

TEST(ParallelLight, RefusesWhatIsNoPoint) {
  const Scene scene(two_sheets());
  const ParallelLight light(scene, {0, 0, -1});
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THROW(light.get_lighten_up(Vector(0, infinity, 0)), Error);
  ParallelLight::On on;
  on.tolerance = -1;
  EXPECT_THROW(light.get_lighten_up(Vector(0), on), Error);
  on.tolerance = 1;
  on.face = 0;
  EXPECT_THROW(light.get_lighten_up(Vector(0), on), Error);
  on.tolerance = 0;
  on.face = 9;
  EXPECT_THROW(light.get_lighten_up(Vector(0), on), Error);
  const std::vector<Vector> points(3, Vector(0));
  std::vector<std::uint8_t> lit(2);
  EXPECT_THROW(light.get_lighten_up(points, lit), Error);
}

}  // namespace
