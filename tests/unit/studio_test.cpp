#include <facemap/error.h>
#include <facemap/studio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

using namespace facemap;

namespace {

/// A cloud of small triangles of another size along each axis, away from the origin.
Mesh cloud(const DVector& size) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const double a = 0.37 * i, b = 0.91 * i;
    mesh.positions.push_back(
        Vector(DVector(100, -50, 7) + size * DVector(std::fmod(a, 1.0), std::fmod(b, 1.0), std::fmod(a * b, 1.0))));
    if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  return mesh;
}

/// The largest distance of a vertex from the middle of the picture, 1 being its edge, on each axis.
DVector spread(const Mesh& mesh, const View& view, double aspect) {
  const DVector sight = glm::normalize(DVector(view.look_at) - DVector(view.position));
  const DVector right = glm::normalize(glm::cross(sight, DVector(view.up)));
  const DVector up = glm::cross(right, sight);
  const double t = std::tan(view.field_angle / 2);
  DVector most(0);
  for (const Vector& vertex : mesh.positions) {
    const DVector p = DVector(vertex) - DVector(view.position);
    const double depth = glm::dot(p, sight);
    EXPECT_GT(depth, 0);
    most.x = std::max(most.x, std::fabs(glm::dot(p, right)) / (depth * t * aspect));
    most.y = std::max(most.y, std::fabs(glm::dot(p, up)) / (depth * t));
  }
  return most;
}

TEST(Studio, TheModelFillsThePicture) {
  for (const DVector size :
       {DVector(1, 1, 1), DVector(9, 1, 1), DVector(1, 9, 1), DVector(1, 1, 9), DVector(5, 0, 5)}) {
    for (const double aspect : {0.5, 1.0, 2.0}) {
      for (const Vector up : {Vector(0, 1, 0), Vector(0, 0, 1), Vector(1, -2, 3)}) {
        const Mesh mesh = cloud(size);
        const Studio studio = make_studio(mesh, up, static_cast<int>(600 * aspect), 600);
        const DVector most = spread(mesh, studio.view, aspect);
        EXPECT_LT(std::max(most.x, most.y), 0.88);
        EXPECT_GT(std::max(most.x, most.y), 0.84) << "1 over the margin, but for the rounding of the place";
      }
    }
  }
}

TEST(Studio, ItTurnsWithUp) {
  const Mesh mesh = cloud({1, 2, 3});
  const Studio upright = make_studio(mesh, {0, 1, 0}, 100, 100);
  EXPECT_GT(upright.view.position.y, upright.view.look_at.y) << "seen from above";
  EXPECT_GT(upright.view.position.z, upright.view.look_at.z) << "from the front";
  const Studio turned = make_studio(mesh, {0, 0, 1}, 100, 100);
  EXPECT_GT(turned.view.position.z, turned.view.look_at.z);
  EXPECT_LT(turned.view.position.y, turned.view.look_at.y);
  ASSERT_EQ(turned.lights.size(), 3u);
  for (const Light& light : turned.lights) EXPECT_GT(light.position.z, bounding_ball(mesh).centre.z);
}

TEST(Studio, RefusesWhatCannotBeShown) {
  EXPECT_THROW(make_studio(Mesh(), {0, 1, 0}, 10, 10), Error);
  EXPECT_THROW(make_studio(cloud({1, 1, 1}), {0, 0, 0}, 10, 10), Error);
}

TEST(MadeUpView, ItTurnsWithUp) {
  const BoundingBall ball{{1, 2, 3}, 5};
  const View y = make_up_view(ball, {0, 1, 0}, View()), z = make_up_view(ball, {0, 0, 1}, View());
  const Vector from_y = y.position - y.look_at, from_z = z.position - z.look_at;
  constexpr float kRounding = 1e-5f;  // of coordinates of a few units
  EXPECT_NEAR(from_z.x, from_y.x, kRounding);
  EXPECT_NEAR(from_z.y, -from_y.z, kRounding);
  EXPECT_NEAR(from_z.z, from_y.y, kRounding);
  EXPECT_EQ(make_up_lights(ball, {0, 0, 1}).size(), 8u);
}

}  // namespace
