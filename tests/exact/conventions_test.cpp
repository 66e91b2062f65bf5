// Which way is right, up and forward, against a projection written a second time from the conventions; and what
// may not change when a scene is renumbered or scaled.

#include <facemap/camera.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/queries.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using test_scenes::add_triangle;
using test_scenes::TestScene;

Vector rounded(const DVector& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

// Right-handed world; sight towards look_at, right = sight x up, up' = right x sight; x to the right, y downwards.
struct Reference {
  DVector right, up, sight;
  ProjectionKind kind;
  double field_angle;
  int width, height;

  Reference(const Vector& position, const Vector& look_at, const Vector& up_hint, const Camera::Options& options)
      : kind(options.projection), field_angle(options.field_angle), width(options.width), height(options.height) {
    sight = glm::normalize(DVector(look_at) - DVector(position));
    right = glm::normalize(glm::cross(sight, DVector(up_hint)));
    up = glm::cross(right, sight);
  }

  MapPoint pixel_of(const DVector& d) const {
    const double x = glm::dot(d, right), y = glm::dot(d, up), z = glm::dot(d, sight);
    double u, v;  // texels right of the centre and above it
    if (kind == ProjectionKind::Plane) {
      const double focal = height / 2.0 / std::tan(field_angle / 2);
      u = focal * x / z;
      v = focal * y / z;
    } else {
      const double around = std::atan2(y, x), from_axis = std::acos(z / glm::length(d));
      const double r = from_axis / (field_angle / 2) * std::min(width, height) / 2.0;
      u = r * std::cos(around);
      v = r * std::sin(around);
    }
    return {width / 2.0 + u, height / 2.0 - v};
  }
};

TEST(Conventions, MapsAgreeWithAnIndependentProjection) {
  constexpr std::uint64_t kSeed = 0x5eed0030;
  Random random(kSeed);
  const Scene scene(test_scenes::box({-1, -2, -3}, {1, 2, 3}));
  for (int round = 0; round < 60; ++round) {
    Camera::Options options;
    options.projection = round % 2 ? ProjectionKind::Plane : ProjectionKind::Surface;
    options.field_angle = round % 2 ? random.between(0.3, 2.8) : random.between(0.3, 2 * M_PI);
    options.width = random.between(8, 90);
    options.height = random.between(8, 90);
    const Vector position = rounded(6.0 * random.direction()), look_at = rounded(random.direction());
    const Vector up = rounded(random.direction());
    const Camera camera(scene, SpaceVector::looking_at(position, look_at, up), options);
    const Reference reference(position, look_at, up, options);
    for (int i = 0; i < 300; ++i) {
      const double u = random.between(0.01, 0.99), v = random.between(0.01, 0.99);
      const MapPoint at(u * options.width, v * options.height);
      const Vector d = camera.direction_through(at);
      if (d == Vector(0)) continue;
      // Directions are float32: 2^-24 of a right angle or so; the map is at most this many texels a radian, and
      // the inverse cosine of the reference is worse near the axis and the antipode.
      const MapPoint back = reference.pixel_of(DVector(d));
      const double bound = 2e-3;
      ASSERT_NEAR(back.x, at.x, bound) << kSeed << ' ' << round;
      ASSERT_NEAR(back.y, at.y, bound) << kSeed << ' ' << round;
      const auto texel = camera.texel_of(DVector(d));
      ASSERT_TRUE(texel);
      ASSERT_NEAR(texel->x + 0.5, at.x, 0.5 + bound);
      ASSERT_NEAR(texel->y + 0.5, at.y, 0.5 + bound);
    }
  }
}

// An arrow to the right with a barb above, seen from the front: no mirror and no rotation maps it onto itself.
TEST(Conventions, PicturesAreNotMirrored) {
  Mesh mesh;
  add_triangle(mesh, {-3, 0, 0}, {3, -1.2f, 0}, {3, 1.2f, 0});  // 0: the shaft, widening to +x
  add_triangle(mesh, {1, 1, 0}, {3, 1, 0}, {1, 3, 0});          // 1: up and to the right
  const Scene scene(mesh);
  const std::vector<std::string> expected = {
      "........", ".....1..", ".....11.", "...0000.", "...0000.", "........", "........", "........",
  };
  for (const ProjectionKind kind : {ProjectionKind::Surface, ProjectionKind::Plane}) {
    Camera::Options options;
    options.projection = kind;
    options.field_angle = 0.8;
    options.width = options.height = 8;
    const Camera camera(scene, SpaceVector::looking_at({0, 0, 9}, {0, 0, 0}), options);
    std::vector<std::string> picture;
    for (int y = 0; y < 8; ++y) {
      std::string row;
      for (int x = 0; x < 8; ++x) {
        const Camera::Hit hit = camera.nearest(camera.direction_through({x + 0.5, y + 0.5}));
        row += hit ? static_cast<char>('0' + hit.face) : '.';
      }
      picture.push_back(row);
    }
    EXPECT_EQ(picture, expected);
  }
}

// The same questions about a scene in another order or another scale.
class Metamorphic : public testing::TestWithParam<test_scenes::Kind> {
 protected:
  static constexpr int kQuestions = 400;

  Metamorphic()
      : random_(0x5eed0031 + static_cast<std::uint64_t>(GetParam())),
        test_(test_scenes::make_scene(GetParam(), 80, random_)),
        camera_at_(test_scenes::make_origin(test_, random_)),
        light_at_(test_scenes::make_origin(test_, random_)) {}

  static Camera camera_of(const Scene& scene, const Vector& position) {
    Camera::Options options;
    options.field_angle = 2 * M_PI;
    options.width = options.height = 24;
    return Camera(scene, SpaceVector::looking_along(position, DVector(1, 2, 3)), options);
  }

  Random random_;
  TestScene test_;
  Vector camera_at_, light_at_;
};

TEST_P(Metamorphic, RenumberedTrianglesGiveTheRenumberedFaces) {
  const Scene scene(test_.mesh);
  Mesh shuffled = test_.mesh;
  std::vector<FaceId> new_id(shuffled.triangles.size());
  std::vector<FaceId> order(shuffled.triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<FaceId>(i);
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random_.below(static_cast<int>(i) + 1)]);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Corners& t = test_.mesh.triangles[order[i]];
    const int first = random_.below(3);
    shuffled.triangles[i] = {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
    new_id[order[i]] = static_cast<FaceId>(i);
  }
  const Scene other(shuffled);
  if (scene.kept_faces().size() != scene.face_count()) return;  // which duplicate stays depends on the order
  const Camera camera = camera_of(scene, camera_at_), other_camera = camera_of(other, camera_at_);
  const PointLight light(scene, light_at_), other_light(other, light_at_);
  for (int i = 0; i < kQuestions; ++i) {
    const Vector d = test_queries::make_camera_query(test_, camera_at_, random_).direction;
    const Camera::Hit hit = camera.nearest(d), other_hit = other_camera.nearest(d);
    ASSERT_EQ(bool(hit), bool(other_hit));
    if (!hit) continue;
    ASSERT_EQ(hit.tied, other_hit.tied);
    ASSERT_EQ(hit.side, other_hit.side);
    if (hit.tied) continue;  // the lower id wins, and that is another face
    ASSERT_EQ(new_id[hit.face], other_hit.face);
    ASSERT_EQ(hit.strictly_inside, other_hit.strictly_inside);
    ASSERT_EQ(light.get_lighten_up(camera.surface_point(d, hit)),
              other_light.get_lighten_up(other_camera.surface_point(d, other_hit)));
  }
}

TEST_P(Metamorphic, ScalingByAPowerOfTwoChangesNothingButDepth) {
  const Scene scene(test_.mesh);
  const Camera camera = camera_of(scene, camera_at_);
  const PointLight light(scene, light_at_);
  for (const int exponent : {-37, -8, 1, 40}) {
    const float factor = std::ldexp(1.0f, exponent);
    const Scene other(test_scenes::scaled(test_.mesh, factor));
    const Camera other_camera = camera_of(other, camera_at_ * factor);
    const PointLight other_light(other, light_at_ * factor);
    for (int i = 0; i < kQuestions; ++i) {
      const Vector d = test_queries::make_camera_query(test_, camera_at_, random_).direction;
      const Camera::Hit hit = camera.nearest(d), other_hit = other_camera.nearest(d);
      ASSERT_EQ(hit.face, other_hit.face) << exponent;
      ASSERT_EQ(hit.tied, other_hit.tied);
      ASSERT_EQ(hit.strictly_inside, other_hit.strictly_inside);
      if (!hit) continue;
      ASSERT_EQ(hit.depth * factor, other_hit.depth);
      ASSERT_EQ(light.get_lighten_up(camera.surface_point(d, hit)),
                other_light.get_lighten_up(other_camera.surface_point(d, other_hit)));
      const Vector p = test_.mesh.positions[i % static_cast<int>(test_.mesh.positions.size())];
      ASSERT_EQ(light.get_lighten_up(p), other_light.get_lighten_up(p * factor));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Metamorphic,
                         testing::Values(test_scenes::Kind::Soup, test_scenes::Kind::Patch, test_scenes::Kind::Slivers,
                                         test_scenes::Kind::Lattice, test_scenes::Kind::Coplanar,
                                         test_scenes::Kind::Boxes, test_scenes::Kind::Ball, test_scenes::Kind::Shell,
                                         test_scenes::Kind::Fan));

}  // namespace
