// What anybody would say of simple scenes, in words other than the contract's.

#include <facemap/camera.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>

#include "support/scenes.h"

namespace {

using namespace facemap;
using test_scenes::add_triangle;
using test_scenes::box;
using test_scenes::geodesic_sphere;
using test_scenes::joined;

Vector rounded(const DVector& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

// A square in the plane z = 0 of two triangles, turned to +z.
Mesh sheet(float size) {
  Mesh mesh;
  mesh.positions = {{-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Camera panorama(const Scene& scene, const Vector& position, const DVector& sight = DVector(0.3, -0.2, -1)) {
  Camera::Options options;
  options.field_angle = 2 * M_PI;
  options.width = options.height = 64;
  return Camera(scene, SpaceVector::looking_along(position, sight), options);
}

TEST(Witness, ALightInAClosedBoxLightsItsInsideOnly) {
  constexpr std::uint64_t kSeed = 0x5eed0010;
  Random random(kSeed);
  const Scene scene(box({-1, -1, -1}, {1, 1, 1}));
  for (const Vector& at : {Vector(0, 0, 0), Vector(0.1f, -0.6f, 0.3f), Vector(0.999f, 0.999f, -0.999f)}) {
    const PointLight light(scene, at);
    const Camera inside = panorama(scene, {0.25f, 0.5f, -0.125f}), outside = panorama(scene, {3, 2, 4});
    for (int i = 0; i < 2000; ++i) {
      const DVector v = random.direction();
      const double cube_radius = 1 / std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
      EXPECT_TRUE(light.get_lighten_up(rounded(v * cube_radius * random.between(0.01, 0.9999)))) << kSeed;
      EXPECT_FALSE(light.get_lighten_up(rounded(v * cube_radius * random.between(1.0001, 50.0)))) << kSeed;
      const Vector d = rounded(v);
      const Camera::Hit wall = inside.nearest(d), face = outside.nearest(d);
      ASSERT_TRUE(wall);
      EXPECT_TRUE(light.get_lighten_up(inside.surface_point(d, wall)));
      EXPECT_FALSE(face && light.get_lighten_up(outside.surface_point(d, face)));
    }
  }
}

TEST(Witness, ASheetLitFromBehindIsDark) {
  const Scene scene(sheet(2));
  for (const float camera_z : {3.0f, -3.0f}) {
    const Camera camera = panorama(scene, {0.5f, 0.25f, camera_z});
    const PointLight above(scene, {-1, 1, 5}), below(scene, {-1, 1, -5}), edge_on(scene, {-5, 1, 0});
    for (const Vector& d : {Vector(0.1f, 0.2f, -1), Vector(-0.25f, -0.1f, -1), Vector(0, 0, -1)}) {
      const Vector towards = d * Vector(1, 1, camera_z > 0 ? 1.0f : -1.0f);
      const Camera::Hit hit = camera.nearest(towards);
      ASSERT_TRUE(hit);
      const SurfacePoint point = camera.surface_point(towards, hit);
      EXPECT_EQ(above.get_lighten_up(point), camera_z > 0);
      EXPECT_EQ(below.get_lighten_up(point), camera_z < 0);
      EXPECT_FALSE(edge_on.get_lighten_up(point));
    }
  }
}

TEST(Witness, AFaceBehindTheCameraIsNotSeen) {
  const Scene scene(sheet(2));
  const Camera camera = panorama(scene, {0.5f, 0.25f, 3});
  EXPECT_TRUE(camera.nearest({0, 0, -1}));
  EXPECT_FALSE(camera.nearest({0, 0, 1}));
  EXPECT_FALSE(camera.nearest({1, 0, 0}));
  EXPECT_EQ(camera.nearest({0, 0, -4}).depth, 3.0f);
  EXPECT_EQ(camera.nearest({0, 0, 1}).depth, std::numeric_limits<float>::infinity());
}

// On a convex solid every face that looks at the light is lit all over.
TEST(Witness, ConvexSolidsHaveNoFalseShadow) {
  constexpr std::uint64_t kSeed = 0x5eed0011;
  Random random(kSeed);
  const DVector centre(100, -57, 211);
  constexpr double kRadius = 10;
  const Scene sphere(geodesic_sphere(4, centre, kRadius));
  const Scene cube(box(rounded(centre - kRadius), rounded(centre + kRadius)));
  std::uint64_t lit = 0;
  for (const Scene* solid : {&sphere, &cube}) {
    for (const double distance : {3.0, 30.0, 300.0, 3000.0, 100000.0}) {
      const PointLight light(*solid, rounded(centre + kRadius * distance * random.direction()));
      const double away = kRadius * random.between(2.0, 9.0);
      const Camera camera = panorama(*solid, rounded(centre + away * random.direction()));
      for (int i = 0; i < 3000; ++i) {
        const int face = random.below(static_cast<int>(solid->face_count()));
        const int corner = random.below(3);  // a vertex, the middle of an edge, or a point inside
        DVector target = solid->mesh().vertex(face, corner);
        if (i % 3 > 0) target = (target + DVector(solid->mesh().vertex(face, (corner + 1) % 3))) / 2.0;
        if (i % 3 > 1) target += 0.3 * (DVector(solid->mesh().vertex(face, (corner + 2) % 3)) - target);
        const Vector d = rounded(target - DVector(camera.position()));
        const Camera::Hit hit = camera.nearest(d);
        if (!hit || light.side(hit.face) != -1) continue;
        EXPECT_EQ(hit.side, -1);
        ASSERT_TRUE(light.get_lighten_up(camera.surface_point(d, hit))) << distance << ' ' << hit.face;
        ++lit;
      }
    }
  }
  std::printf("seed %#llx: %llu lit points\n", static_cast<unsigned long long>(kSeed),
              static_cast<unsigned long long>(lit));
  EXPECT_GT(lit, 5000u);
}

TEST(Witness, FoldsAndCoplanarPatchesCastNoShadowOnThemselves) {
  Random random(0x5eed0012);
  Mesh mesh;
  // A roof seen from above, ridge and all, and a floor of overlapping tiles beside it.
  add_triangle(mesh, {-1, 0, 0}, {0, 0, 1}, {0, 1, 1});
  add_triangle(mesh, {-1, 0, 0}, {0, 1, 1}, {-1, 1, 0});
  add_triangle(mesh, {0, 0, 1}, {1, 0, 0}, {1, 1, 0});
  add_triangle(mesh, {0, 0, 1}, {1, 1, 0}, {0, 1, 1});
  for (int i = 0; i < 40; ++i) {
    const auto x = static_cast<float>(random.between(2, 6)), y = static_cast<float>(random.between(-3, 3));
    add_triangle(mesh, {x, y, 0}, {x + 2, y, 0}, {x + 1, y + 2, 0});
  }
  const Scene scene(mesh);
  const PointLight light(scene, {1, 0.5f, 7});
  const Camera camera = panorama(scene, {-0.5f, 0.75f, 6});
  int seen = 0;
  for (int i = 0; i < 5000; ++i) {
    const int face = random.below(static_cast<int>(mesh.face_count()));
    const Vector target = 0.125f * (float(random.between(0, 4)) * (mesh.vertex(face, 1) - mesh.vertex(face, 0)) +
                                    float(random.between(0, 4)) * (mesh.vertex(face, 2) - mesh.vertex(face, 0)));
    const Vector d = mesh.vertex(face, 0) + target - camera.position();
    const Camera::Hit hit = camera.nearest(d);
    if (!hit) continue;
    ++seen;
    ASSERT_TRUE(light.get_lighten_up(camera.surface_point(d, hit))) << face;
    ASSERT_TRUE(light.get_lighten_up(mesh.vertex(face, i % 3)));
  }
  EXPECT_GT(seen, 4000);
}

// The shadow of a ball on a plane. With the light at height H, phi the angle between the plane's normal and the
// line to the ball's centre, gamma = asin(r / distance), it is the ellipse of half axes
// H (tan(phi + gamma) - tan(phi - gamma)) / 2 and H sin gamma / sqrt(cos^2 gamma - sin^2 phi).
TEST(Witness, TheShadowOfABallIsTheEllipseOfKnownAxes) {
  constexpr int kSplits = 5;
  // The inscribed solid's faces come closer to the centre than its vertices by the square of their circumradius
  // over twice the radius; edges of an icosahedron (1.0515) halve with each split and grow by 20 % at most.
  const double circumradius = 1.2 * 1.0515 / (1 << kSplits) / std::sqrt(3.0);
  const double flattening = circumradius * circumradius / 2;
  const DVector light_at(0, 0, 8), ball(2, 0, 3);
  constexpr double kBall = 1;
  Mesh floor = sheet(40);
  const Scene scene(joined(floor, geodesic_sphere(kSplits, ball, kBall)));
  const PointLight light(scene, rounded(light_at));
  const Camera camera = panorama(scene, {12, -9, 2});

  const auto probe = [&](double radius, double stretch, bool expect_lit) {
    const DVector axis = ball - light_at;
    const double H = light_at.z, phi = std::atan2(axis.x, -axis.z), gamma = std::asin(radius / glm::length(axis));
    const double centre = H * (std::tan(phi + gamma) + std::tan(phi - gamma)) / 2;
    const double a = H * (std::tan(phi + gamma) - std::tan(phi - gamma)) / 2;
    const double b = H * std::sin(gamma) / std::sqrt(std::pow(std::cos(gamma), 2) - std::pow(std::sin(phi), 2));
    for (int i = 0; i < 720; ++i) {
      const double t = i * M_PI / 360;
      const Vector p = rounded({centre + stretch * a * std::cos(t), stretch * b * std::sin(t), 0});
      EXPECT_EQ(light.get_lighten_up(p), expect_lit) << stretch << ' ' << i;
      const Vector d = p - camera.position();
      const Camera::Hit hit = camera.nearest(d);
      if (!hit || hit.face >= 2) continue;  // the ball is in front of it
      EXPECT_EQ(light.get_lighten_up(camera.surface_point(d, hit)), expect_lit) << i;
    }
  };
  constexpr double kFloatSlack = 1e-5;  // of the ellipse: positions are float32
  probe(kBall, 1 + kFloatSlack, true);
  probe(kBall * (1 - flattening), 1 - kFloatSlack, false);
  probe(kBall, 0.5, false);
  probe(kBall, 1.5, true);
}

}  // namespace
