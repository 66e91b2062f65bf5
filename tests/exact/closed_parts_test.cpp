// A theorem as a witness: on closed solids the faces turned away from the light (the exits) give the answer of all
// faces, for points that a camera outside sees strictly inside their face and untied, on the side that faces the
// light. (Seen from behind, the light's last step to the point is inside the solid, and its entry has no exit.)

#include <facemap/camera.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "support/oracle.h"
#include "support/queries.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using test_scenes::box;
using test_scenes::joined;

// Only the faces with side > 0 from `light`; ids are not kept.
Mesh exits_of(const Scene& scene, const PointLight& light) {
  Mesh mesh;
  mesh.positions = scene.mesh().positions;
  for (const std::uint32_t face : scene.kept_faces()) {
    if (light.side(static_cast<FaceId>(face)) > 0) mesh.triangles.push_back(scene.mesh().triangles[face]);
  }
  return mesh;
}

bool is_outside_box(const Scene& scene, const Vector& p) {
  for (int i = 0; i < 3; ++i) {
    if (p[i] < scene.lower()[i] || p[i] > scene.upper()[i]) return true;
  }
  return false;
}

struct Count {
  int asked = 0, blocked = 0;
};

// Every answer about what `camera` sees, from all faces and from the exits.
void compare(const Scene& scene, const Vector& camera_at, const Vector& light_at, const std::vector<Vector>& directions,
             Count& count) {
  ASSERT_TRUE(is_outside_box(scene, camera_at) && is_outside_box(scene, light_at));
  Camera::Options options;
  options.field_angle = 2 * M_PI;
  options.width = options.height = 48;
  const Camera camera(scene, SpaceVector::looking_along(camera_at, scene.centre() - DVector(camera_at)), options);
  const PointLight light(scene, light_at);
  const Mesh exit_mesh = exits_of(scene, light);
  if (exit_mesh.triangles.empty()) return;
  const Scene exit_scene(exit_mesh);
  const PointLight light_on_exits(exit_scene, light_at);
  for (const Vector& d : directions) {
    const Camera::Hit hit = camera.nearest(d);
    if (!hit || !hit.strictly_inside || hit.tied || hit.side != light.side(hit.face)) continue;
    SurfacePoint point = camera.surface_point(d, hit);
    const bool by_all = light.is_blocked(point);
    point.face = kNoFace;  // its id is another one among the exits
    ASSERT_EQ(light_on_exits.is_blocked(point), by_all)
        << "camera " << test_queries::text(camera_at) << ", light " << test_queries::text(light_at) << ", along "
        << test_queries::text(d) << "; " << test_queries::write_failure(scene.mesh(), test_queries::text(d));
    ++count.asked;
    count.blocked += by_all;
  }
}

std::vector<Vector> directions_to(const Scene& scene, const Vector& from, int count, Random& random) {
  std::vector<Vector> directions;
  const DVector size = DVector(scene.upper()) - DVector(scene.lower());
  for (int i = 0; i < count; ++i) {
    const DVector at = scene.centre() + 0.55 * size * random.in_cube();
    directions.emplace_back(at - DVector(from));
  }
  return directions;
}

Vector outside(const Scene& scene, Random& random) {
  while (true) {
    const DVector towards = random.direction();
    const Vector p(scene.centre() + random.between(0.6, 3.0) * scene.bounding_radius() * towards);
    if (is_outside_box(scene, p)) return p;
  }
}

// The L-shaped prism (0,0 4,0 4,1 1,1 1,4 0,4), z from -2 to 2.
Mesh l_prism() {
  Mesh mesh;
  const std::array<glm::vec2, 6> outline = {{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}};
  for (const float z : {-2.0f, 2.0f}) {
    for (const glm::vec2& p : outline) mesh.positions.emplace_back(p.x, p.y, z);
  }
  for (const auto& [a, b, c] : std::initializer_list<Corners>{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
    mesh.triangles.push_back({a, c, b});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

TEST(ClosedParts, ExitsAnswerForTheLShapedPrism) {
  const Scene scene(l_prism());
  Random random(0x5eed0020);
  Count count;
  std::vector<Vector> directions = directions_to(scene, {5, 5, 0}, 2000, random);
  directions.emplace_back(-4.0f, -4.0f, 0.0f);  // into the inner corner: an edge, so not asked
  compare(scene, {5, 5, 0}, {-6, 4, 0}, directions, count);
  EXPECT_GT(count.asked, 500);
  EXPECT_GT(count.blocked, 100);
  // On that edge the exits alone would be wrong or right by luck: it must not count as strictly inside.
  Camera::Options options;
  options.field_angle = 2 * M_PI;
  const Camera camera(scene, SpaceVector::looking_along({5, 5, 0}, {-1, -1, 0}), options);
  const Camera::Hit corner = camera.nearest({-4, -4, 0});
  ASSERT_TRUE(corner);
  EXPECT_FALSE(corner.strictly_inside);
}

TEST(ClosedParts, ExitsAnswerForABoxRestingOnASlab) {
  const Scene scene(joined(box({-4, -4, -1}, {4, 4, 0}), box({-1, -1, 0}, {1, 1, 2})));
  Random random(0x5eed0021);
  Count count;
  for (int i = 0; i < 80; ++i) {
    const Vector camera = outside(scene, random), light = outside(scene, random);
    compare(scene, camera, light, directions_to(scene, camera, 200, random), count);
  }
  EXPECT_GT(count.asked, 2000);
  EXPECT_GT(count.blocked, 300);
}

// Inside out where the top has passed the bottom: the winding number there is -1.
TEST(ClosedParts, ExitsAnswerForABoxWhoseTopIsPushedThroughItsBottom) {
  Mesh mesh = box({-2, -2, 0}, {2, 2, 2});
  for (const int top : {4, 5, 6, 7})
    mesh.positions[top] = mesh.positions[top] * Vector(0.5f, 0.5f, 0) + Vector(0, 0, -1);
  const Scene scene(joined(mesh, box({3, -1, -2}, {4, 1, 1})));  // with a neighbour that it can shade
  Random random(0x5eed0022);
  Count count;
  for (int i = 0; i < 60; ++i) {
    const Vector camera = outside(scene, random), light = outside(scene, random);
    compare(scene, camera, light, directions_to(scene, camera, 100, random), count);
  }
  EXPECT_GT(count.asked, 1000);
  EXPECT_GT(count.blocked, 50);
}

// Nested, overlapping, turned inside out, crushed: all that counts is that directed edges cancel.
TEST(ClosedParts, ExitsAnswerForRandomSolids) {
  constexpr std::uint64_t kSeed = 0x5eed0023;
  Random random(kSeed);
  Count count;
  for (int round = 0; round < 250; ++round) {
    Mesh mesh;
    for (int i = random.between(1, 4); i > 0; --i) {
      const int slices = random.between(3, 9), stacks = random.between(2, 6);
      const DVector a = random.in_cube(), b = random.in_cube();
      const double radius = random.between(0.2, 1.5);
      Mesh solid = random.chance(0.5) ? test_scenes::uv_sphere(slices, stacks, a, radius)
                                      : box(Vector(-2.0 + a), Vector(0.5 + b));
      if (random.chance(0.3)) {
        for (Corners& t : solid.triangles) std::swap(t[1], t[2]);
      }
      if (random.chance(0.4)) {  // shuffled vertices: self-intersecting, still closed
        for (Vector& v : solid.positions) v = Vector(2.0 * random.in_cube());
      }
      mesh = joined(mesh, solid);
    }
    const Scene scene(mesh);
    if (scene.kept_faces().size() != scene.face_count()) continue;
    for (int i = 0; i < 3; ++i) {
      const Vector camera = outside(scene, random), light = outside(scene, random);
      compare(scene, camera, light, directions_to(scene, camera, 150, random), count);
      if (HasFatalFailure()) return;
    }
  }
  std::printf("seed %#llx: %d points asked, %d blocked\n", static_cast<unsigned long long>(kSeed), count.asked,
              count.blocked);
  EXPECT_GT(count.asked, 20000);
  EXPECT_GT(count.blocked, 5000);
}

}  // namespace
