// The referee itself, on cases small enough to do by hand.

#include "support/oracle.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "support/queries.h"
#include "support/scenes.h"

namespace {

using facemap::FaceId;
using facemap::kNoFace;
using facemap::Mesh;
using facemap::PointLight;
using facemap::SurfacePoint;
using facemap::Vector;
using oracle::Oracle;
using oracle::View;
using test_scenes::add_triangle;
using test_scenes::box;
using test_scenes::joined;

// In the plane z = height, counter-clockwise seen from +z.
Mesh floor_at(float height, float size) {
  Mesh mesh;
  mesh.positions = {{-size, -size, height}, {size, -size, height}, {size, size, height}, {-size, size, height}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

SurfacePoint seen(const Oracle& oracle, const Vector& camera, const Vector& d, int face) {
  const Mesh& mesh = oracle.mesh();
  return {
      camera, d, {mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2)}, face, oracle.side(face, camera)};
}

TEST(Oracle, KeepsEachTriangleOnceAndNoneWithoutArea) {
  Mesh mesh;
  add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_triangle(mesh, {0, 0, 0}, {1, 1, 1}, {3, 3, 3});             // on a line
  add_triangle(mesh, {0, 1, 0}, {1, 0, 0}, {-0.0f, 0, -0.0f});     // the first one, turned around
  add_triangle(mesh, {0, 0, 0}, {0, 0, 0}, {1, 2, 3});             // two corners in one place
  add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0.5f, 0x1p-149f, 0});  // as thin as floats allow
  EXPECT_EQ(Oracle(mesh).kept_faces(), (std::vector<facemap::FaceId>{0, 4}));
}

TEST(Oracle, SideIsMinusOneForAFaceTurnedTowardsThePoint) {
  const Mesh mesh = floor_at(0, 1);
  const Oracle oracle(mesh);
  EXPECT_EQ(oracle.side(0, {0, 0, 5}), -1);
  EXPECT_EQ(oracle.side(0, {0, 0, -5}), 1);
  EXPECT_EQ(oracle.side(0, {7, 0, 0}), 0);
  EXPECT_EQ(oracle.side(0, {7, 0, 0x1p-149f}), -1);
}

TEST(Oracle, NearestFaceIsInFrontAndEdgesBelongToBothFaces) {
  const Mesh mesh = joined(floor_at(0, 4), floor_at(-1, 8));
  const Oracle oracle(mesh);
  const View view = oracle.from({0, 0, 2});
  const oracle::Hit inside = view.nearest({0.5f, -0.25f, -1});
  EXPECT_EQ(inside.face, 0);
  EXPECT_TRUE(inside.strictly_inside);
  EXPECT_FALSE(inside.tied);
  EXPECT_EQ(inside.side, -1);
  EXPECT_EQ(view.count_hits({0.5f, -0.25f, -1}), 2);

  const oracle::Hit on_diagonal = view.nearest({0, 0, -1});
  EXPECT_EQ(on_diagonal.face, 0);
  EXPECT_FALSE(on_diagonal.strictly_inside);
  EXPECT_TRUE(on_diagonal.tied);
  EXPECT_EQ(view.count_hits({0, 0, -1}), 4);

  EXPECT_EQ(view.nearest({2, 2, -1}).face, 0);           // a corner
  EXPECT_EQ(view.nearest({2, 2.0000002f, -1}).face, 3);  // one ulp past it: the lower floor
  EXPECT_EQ(view.nearest({0, 0, 1}).face, kNoFace);      // both floors are behind
  EXPECT_EQ(view.nearest({0, 0, 0}).face, kNoFace);
  EXPECT_EQ(oracle.from({0, 0, 0}).nearest({1, 0, 0}).face, kNoFace);  // its own plane is seen edge-on
}

TEST(Oracle, TheFaceTurnedTowardsTheCameraWinsATie) {
  Mesh mesh;
  add_triangle(mesh, {0, 0, 0}, {0, 4, 0}, {4, 0, 0});  // turned to -z
  add_triangle(mesh, {0, 0, 0}, {4, 0, 0}, {0, 3, 0});  // turned to +z
  const Oracle oracle(mesh);
  EXPECT_EQ(oracle.from({1, 1, 2}).nearest({0, 0, -1}).face, 1);
  EXPECT_TRUE(oracle.from({1, 1, 2}).nearest({0, 0, -1}).tied);
  EXPECT_EQ(oracle.from({1, 1, -2}).nearest({0, 0, 1}).face, 0);
}

TEST(Oracle, APointIsDarkBehindAFaceAndLitOnOrBeforeIt) {
  const Mesh mesh = floor_at(0, 1);
  const Oracle oracle(mesh);
  const View light = oracle.from({0, 0, 4});
  const PointLight::On nowhere;
  EXPECT_TRUE(light.is_lit(Vector{0.3f, 0.2f, 1}, nowhere));
  EXPECT_TRUE(light.is_lit(Vector{0.3f, 0.2f, 0}, nowhere));            // on the plane
  EXPECT_FALSE(light.is_lit(Vector{0.3f, 0.2f, -0x1p-149f}, nowhere));  // the least that a float can be behind it
  EXPECT_TRUE(light.is_lit(Vector{3, 0, -1}, nowhere));                 // beside it
  EXPECT_FALSE(light.is_lit(Vector{1.25f, 0, -1}, nowhere));            // grazes the rim: edges belong to faces
  EXPECT_TRUE(light.is_lit(Vector{1.2500001f, 0, -1}, nowhere));
  EXPECT_TRUE(light.is_lit(Vector{0, 0, 4}, nowhere));  // the light itself
}

TEST(Oracle, APointMayBeSaidToLieOnAFaceOrNearIt) {
  const Mesh mesh = joined(floor_at(0, 1), floor_at(1, 0.25f));
  const Oracle oracle(mesh);
  const View light = oracle.from({0, 0, 4});
  const Vector below{0.5f, -0.25f, -0.125f}, in_shade{0.125f, -0.0625f, -0.125f};
  EXPECT_FALSE(light.is_lit(below, {}));
  EXPECT_TRUE(light.is_lit(below, {.face = 0}));
  EXPECT_FALSE(light.is_lit(in_shade, {.face = 0}));
  EXPECT_TRUE(light.is_lit(below, {.tolerance = 0.125f}));  // exactly as far as allowed
  EXPECT_FALSE(light.is_lit(below, {.tolerance = 0.12499999f}));
  EXPECT_FALSE(light.is_lit(in_shade, {.tolerance = 0.125f}));
}

TEST(Oracle, ASeenPointIsLitOnTheSideThatTheCameraSees) {
  const Mesh mesh = joined(floor_at(0, 4), floor_at(1, 0.5f));
  const Oracle oracle(mesh);
  const Vector camera{2, 1, 3}, down{0.125f, 0.0625f, -1};
  const SurfacePoint on_floor = seen(oracle, camera, down, 0);
  EXPECT_TRUE(oracle.from({3, 3, 5}).is_lit(on_floor));
  EXPECT_FALSE(oracle.from({3, 3, -5}).is_lit(on_floor));      // from behind
  EXPECT_FALSE(oracle.from({-3, 3, 0}).is_lit(on_floor));      // on the plane: dark
  EXPECT_FALSE(oracle.from({-3, 3, 0}).is_blocked(on_floor));  // though nothing is between
  // P = (2.375, 1.1875, 0). A light at 2 (0,0,1) - P sends its light through the middle of the small square.
  EXPECT_FALSE(oracle.from({-2.375f, -1.1875f, 2}).is_lit(on_floor));
  // Straight through the square's rim x = 1/2: edges block.
  EXPECT_FALSE(oracle.from({-1.375f, -1.1875f, 2}).is_lit(on_floor));
  EXPECT_TRUE(oracle.from({-1.3749999f, -1.1875f, 2}).is_lit(on_floor));
}

TEST(Oracle, AllHitsComeInOrderAndTheFirstBlockerIsTheFirstBeforeThePoint) {
  const Mesh mesh = joined(floor_at(0, 1), floor_at(1, 0.25f));
  const Oracle oracle(mesh);
  const View view = oracle.from({0, 0, 4});
  const Vector down{0.01f, -0.02f, -1};
  const std::vector<FaceId> hits = view.all_hits(down);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_GE(hits[0], 2);
  EXPECT_LT(hits[1], 2);
  EXPECT_TRUE(view.meets(hits[0], down) && view.meets(hits[1], down));
  const auto at = [&](float t) { return Vector(0, 0, 4) + t * down; };
  EXPECT_EQ(view.first_blocker(at(5), kNoFace), hits[0]);
  EXPECT_EQ(view.first_blocker(at(5), hits[0]), hits[1]);
  EXPECT_EQ(view.first_blocker(at(3.5f), kNoFace), hits[0]);
  EXPECT_EQ(view.first_blocker(at(3.5f), hits[0]), kNoFace);
  EXPECT_EQ(view.first_blocker(at(3), kNoFace), kNoFace);  // on the plane
  EXPECT_EQ(view.first_blocker({0, 0, 4}, kNoFace), kNoFace);

  Mesh folded;
  add_triangle(folded, {0, 0, 0}, {0, 4, 0}, {4, 0, 0});  // turned to -z
  add_triangle(folded, {0, 0, 0}, {4, 0, 0}, {0, 3, 0});  // turned to +z
  add_triangle(folded, {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  const Oracle ties(folded);
  const View above = ties.from({1, 1, 2});
  EXPECT_EQ(above.all_hits({0, 0, -1}), (std::vector<FaceId>{1, 2, 0}));
  EXPECT_EQ(above.first_blocker({1, 1, -1}, kNoFace), 1);
  EXPECT_EQ(above.first_blocker({1, 1, -1}, 1), 2);
}

TEST(Oracle, DoublesSayWhatIntegersSay) {
  constexpr std::uint64_t kSeed = 0x5eed0001;
  Random random(kSeed);
  std::uint64_t signs_left_over = 0;
  for (int round = 0; round < 60; ++round) {
    const test_scenes::TestScene scene = test_scenes::make_any_scene(random, 40);
    const Oracle oracle(scene.mesh);
    const Vector camera = test_scenes::make_origin(scene, random), light = test_scenes::make_origin(scene, random);
    const View view = oracle.from(camera), exact_view = oracle.from_by_integers(camera);
    const View lit = oracle.from(light), exactly_lit = oracle.from_by_integers(light);
    for (int i = 0; i < 60; ++i) {
      const Vector d = test_queries::make_camera_query(scene, camera, random).direction;
      ASSERT_EQ(view.nearest(d), exact_view.nearest(d)) << scene.name << test_queries::text(d);
      ASSERT_EQ(view.count_hits(d), exact_view.count_hits(d)) << scene.name << test_queries::text(d);
      ASSERT_EQ(view.all_hits(d), exact_view.all_hits(d)) << scene.name << test_queries::text(d);
      const test_queries::LightQuery q = test_queries::make_light_query(scene, oracle, view, light, random);
      ASSERT_EQ(q.is_seen ? lit.is_lit(q.seen) : lit.is_lit(q.given, q.on),
                q.is_seen ? exactly_lit.is_lit(q.seen) : exactly_lit.is_lit(q.given, q.on))
          << scene.name << test_queries::text(q);
      if (q.is_seen) continue;
      const FaceId first = lit.first_blocker(q.given, kNoFace);
      ASSERT_EQ(first, exactly_lit.first_blocker(q.given, kNoFace)) << scene.name << test_queries::text(q);
      ASSERT_EQ(first == kNoFace, lit.is_lit(q.given, {})) << scene.name << test_queries::text(q);
    }
    signs_left_over += view.exact_signs() + lit.exact_signs();
  }
  std::printf("seed %#llx: doubles left %llu signs to the integers\n", static_cast<unsigned long long>(kSeed),
              static_cast<unsigned long long>(signs_left_over));
  EXPECT_GT(signs_left_over, 1000u);
}

TEST(Scenes, ClosedMakersTurnTheirFacesOutwards) {
  for (const Mesh& mesh : {box({-1, -2, -3}, {1, 2, 3}), test_scenes::uv_sphere(12, 7, {0, 0, 0}, 1),
                           test_scenes::geodesic_sphere(2, {0, 0, 0}, 1)}) {
    const Oracle oracle(mesh);
    ASSERT_EQ(oracle.kept_faces().size(), mesh.face_count());
    for (const facemap::FaceId face : oracle.kept_faces()) EXPECT_EQ(oracle.side(face, {0, 0, 0}), 1);
  }
}

}  // namespace
