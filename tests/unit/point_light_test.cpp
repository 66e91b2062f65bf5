#include <facemap/error.h>
#include <facemap/point_light.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "simd/target.h"
#include "support/scenes.h"

namespace {

using namespace facemap;

// Vertices, points of planes and edges, points anywhere near and far, the light itself.
std::vector<Vector> make_points(const test_scenes::TestScene& test, const Scene& scene, const Vector& light,
                                Random& random) {
  std::vector<Vector> points;
  const auto add_if_finite = [&](const DVector& p) {
    const Vector rounded(p);
    if (std::isfinite(rounded.x + rounded.y + rounded.z)) points.push_back(rounded);
  };
  for (int i = random.between(0, 300); i > 0; --i) {
    const auto face = static_cast<std::size_t>(random.below(static_cast<int>(scene.face_count())));
    const DVector a(scene.mesh().vertex(face, 0)), b(scene.mesh().vertex(face, 1)), c(scene.mesh().vertex(face, 2));
    switch (random.below(6)) {
      case 0:
        add_if_finite(a);
        break;
      case 1:
        add_if_finite(0.5 * (a + b));
        break;
      case 2:
        add_if_finite(a + random.unit() * (b - a) + random.unit() * (c - a));
        break;
      case 3:
        points.push_back(light);
        break;
      case 4:
        add_if_finite(random.in_cube() * std::ldexp(1.0, random.between(-100, 100)));
        break;
      default:
        add_if_finite(DVector(test.centre) + random.in_cube() * test.radius * 1.5);
    }
  }
  return points;
}

bool operator==(const Counters& a, const Counters& b) {
  return a.by_float == b.by_float && a.by_double == b.by_double && a.by_exact == b.by_exact;
}

TEST(PointLight, PointsTogetherGetTheAnswersOfPointsOneByOneOnEveryTarget) {
  const simd::Target best = simd::active_target();
  Random random(31);
  int planes = 0, surfaces = 0, dark = 0;
  for (int round = 0; round < 400; ++round) {
    const test_scenes::TestScene test = test_scenes::make_any_scene(random, 80);
    const Scene scene(test.mesh);
    const Vector outside(DVector(test.centre) + 4 * test.radius * random.direction());
    const bool is_outside = random.chance(0.5) && std::isfinite(outside.x + outside.y + outside.z);
    const Vector position = is_outside ? outside : test_scenes::make_origin(test, random);
    const PointLight light(scene, position);
    (light.projection().kind() == ProjectionKind::Plane ? planes : surfaces) += 1;
    const std::vector<Vector> points = make_points(test, scene, position, random);
    std::vector<std::uint8_t> one_by_one;
    Counters counters;
    for (const Vector& p : points) one_by_one.push_back(light.get_lighten_up(p, &counters));
    for (const simd::Target target : simd::supported_targets()) {
      simd::set_active_target(target);
      std::vector<std::uint8_t> together(points.size(), 2);
      Counters own;
      light.get_lighten_up(points, together, &own);
      EXPECT_EQ(together, one_by_one) << test.name << ' ' << simd::name_of(target);
      EXPECT_TRUE(own == counters) << test.name << ' ' << simd::name_of(target);
    }
    simd::set_active_target(best);
    for (const std::uint8_t lit : one_by_one) dark += lit == 0;
  }
  EXPECT_GT(planes, 50);
  EXPECT_GT(surfaces, 50);
  EXPECT_GT(dark, 1000);
}

TEST(PointLight, PointsTogetherMustBeFiniteAndHaveAsManyAnswers) {
  const Scene scene(test_scenes::box({0, 0, 0}, {1, 1, 1}));
  const PointLight light(scene, {0, 0, 5});
  std::vector<Vector> points(100, Vector(2, 2, 2));
  std::vector<std::uint8_t> lit(100), too_few(99);
  EXPECT_THROW(light.get_lighten_up(points, too_few), Error);
  points[70].y = std::numeric_limits<float>::infinity();
  EXPECT_THROW(light.get_lighten_up(points, lit), Error);
  points[70].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(light.get_lighten_up(points, lit), Error);
}

TEST(PointLight, ALightOutsideTakesAPlaneThatHoldsTheScene) {
  const Scene wide(test_scenes::box({-8, -1, -1}, {8, 1, 1}));
  const PointLight outside(wide, {0, 0, 20});
  EXPECT_EQ(outside.projection().kind(), ProjectionKind::Plane);
  EXPECT_GT(outside.width(), 3 * outside.height());
  for (const Vector& v : wide.mesh().positions) {
    EXPECT_TRUE(outside.texel_of(DVector(v) - DVector(outside.position())));
  }
  EXPECT_EQ(PointLight(wide, {0, 0, 1.5f}).projection().kind(), ProjectionKind::Surface);
  EXPECT_EQ(PointLight(wide, {0, 0, 0}).projection().field_angle(), 2 * M_PI);
}

// More faces than the filter hands on at a time, each undecided: the point lies on the plane of all of them.
TEST(PointLight, ManyUndecidedFacesInOneListAreAllAsked) {
  Mesh mesh;
  for (int i = 0; i < 300; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const float size = 1 + 0.001f * static_cast<float>(i);
    for (const Vector& v : {Vector(-size, -size, 0), Vector(size, -size, 0), Vector(0, size, 0)}) {
      mesh.positions.push_back(v);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const auto last = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector& v : {Vector(-1, -1, -0x1p-20f), Vector(1, -1, -0x1p-20f), Vector(0, 1, -0x1p-20f)}) {
    mesh.positions.push_back(v);
  }
  Mesh sheets = mesh;
  sheets.triangles.push_back({last, last + 1, last + 2});
  PointLight::Options options;
  options.keep_all = true;  // whole lists
  const Scene scene(mesh), scene_with_last(sheets);
  const PointLight light(scene, {0, 0, 5}, options);
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, 0)));
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, -0x1p-60f)));
  // Undecided for the filter too, and the only one that blocks.
  const PointLight light_from_below(scene_with_last, {0, 0, -5}, options);
  EXPECT_FALSE(light_from_below.get_lighten_up(Vector(0, 0, 0)));
  PointLight::On on;
  on.tolerance = 0x1p-19f;
  EXPECT_TRUE(light_from_below.get_lighten_up(Vector(0, 0, 0), on));
}

// Two sheets, the near one covering whole texels: the far one is in no list behind it. A point of the near sheet's
// back, within the tolerance of it, is beyond its cut but not blocked by it.
TEST(PointLight, AToleranceReachesBeyondTheCut) {
  Mesh mesh;
  mesh.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 12, 0}, {-9, -9, -1}, {9, -9, -1}, {0, 12, -1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const Scene scene(mesh);
  const PointLight light(scene, {0, 0, 5});
  PointLight::On on;
  on.tolerance = 0.5f;
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, -0.25f), on));
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, -0.75f), on));
  on.tolerance = 3;
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, -8), on));
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, -2.5f), on)) << "within the tolerance of both";
  on.tolerance = 2;
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, -2.5f), on));
}

}  // namespace
