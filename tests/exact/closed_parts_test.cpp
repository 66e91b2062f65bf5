// A theorem as a witness: on closed solids the faces turned away from the light (the exits) give the answer of all
// faces, for points that a camera outside sees strictly inside their face and untied, on the side that faces the
// light. (Seen from behind, the light's last step to the point is inside the solid, and its entry has no exit.)

#include "scene/closed_parts.h"

#include <facemap/camera.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "math/exact_sign.h"
#include "parallel/executor.h"
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

// ---- the parts as they are found ------------------------------------------------------------------------

Triangle triangle_of(const Scene& scene, std::size_t face) {
  return {scene.mesh().vertex(face, 0), scene.mesh().vertex(face, 1), scene.mesh().vertex(face, 2)};
}

struct EntryCount : Count {
  int skipped = 0;  ///< blocked by an entry that may be skipped, too
};

/// Points that the camera sees as the theorem asks, blocked by any face and by any but the entries of closed parts.
void compare_entries(const Scene& scene, const Vector& camera_at, const Vector& light,
                     const std::vector<Vector>& directions, EntryCount& count) {
  const ClosedParts parts(scene, Executor(1));
  std::vector<std::uint8_t> skippable = parts.skippable_entries(scene, camera_at, light);
  if (skippable.empty()) return;
  std::vector<int> sides(scene.face_count(), 0);
  for (const std::uint32_t face : scene.kept_faces()) {
    sides[face] = side(triangle_of(scene, face), light);
    if (sides[face] > 0) skippable[face] = 0;  // an exit
  }
  Camera::Options options;
  options.field_angle = 2 * M_PI;
  options.width = options.height = 32;
  const Camera camera(scene, SpaceVector::looking_along(camera_at, {0, 0, 1}), options);
  for (const Vector& d : directions) {
    const Camera::Hit hit = camera.nearest(d);
    if (!hit || !hit.strictly_inside || hit.tied || hit.side != sides[hit.face]) continue;
    const TruePoint point{camera_at, d, triangle_of(scene, hit.face), hit.side};
    bool by_entry = false, by_rest = false;
    for (const std::uint32_t face : scene.kept_faces()) {
      if (skippable[face] != 0 ? by_entry : by_rest) continue;
      const bool is_blocked = blocks(triangle_of(scene, face), sides[face], light, point);
      (skippable[face] != 0 ? by_entry : by_rest) |= is_blocked;
    }
    ASSERT_TRUE(by_rest || !by_entry) << "camera " << test_queries::text(camera_at) << ", light "
                                      << test_queries::text(light) << ", along " << test_queries::text(d) << "; "
                                      << test_queries::write_failure(scene.mesh(), test_queries::text(d));
    ++count.asked;
    count.blocked += by_rest;
    count.skipped += by_entry;
  }
}

Mesh inside_out(Mesh mesh) {
  for (Corners& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// A square frame about the z axis, z from -1 to 1: the hole is 2 wide, the frame 6.
Mesh ring() {
  Mesh mesh;
  for (const float half : {1.0f, 3.0f}) {
    for (const float z : {-1.0f, 1.0f}) {
      for (const auto& [x, y] : std::initializer_list<std::pair<float, float>>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        mesh.positions.emplace_back(half * x, half * y, z);
      }
    }
  }
  // Rows of four: inner bottom, inner top, outer bottom, outer top; joined round the section of the frame.
  const auto join_rows = [&](std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t j = (i + 1) % 4;
      mesh.triangles.push_back({4 * a + i, 4 * a + j, 4 * b + j});
      mesh.triangles.push_back({4 * a + i, 4 * b + j, 4 * b + i});
    }
  };
  join_rows(2, 3), join_rows(3, 1), join_rows(1, 0), join_rows(0, 2);
  return mesh;
}

bool may_skip(const Scene& scene, const Vector& camera, const Vector& light) {
  return !ClosedParts(scene, Executor(1)).skippable_entries(scene, camera, light).empty();
}

TEST(ClosedParts, ARayTellsWhoIsInTheInnerCornerOfTheLShapedPrism) {
  const Scene scene(l_prism());
  EXPECT_TRUE(may_skip(scene, {5, 5, 0}, {2, 3, 0.5f}));   // in its box, not in it
  EXPECT_TRUE(may_skip(scene, {3, 3, 0}, {2, 3, 0.5f}));   // on the grid
  EXPECT_FALSE(may_skip(scene, {5, 5, 0}, {0.5f, 3, 0}));  // in it
  EXPECT_FALSE(may_skip(scene, {0.5f, 3, 0}, {5, 5, 0}));
  EXPECT_FALSE(may_skip(scene, {5, 5, 0}, {2, 1, 0}));  // on it
  EXPECT_FALSE(may_skip(scene, {5, 5, 0}, {1, 1, 0}));
  EXPECT_FALSE(may_skip(scene, {1, 1, 2}, {5, 5, 0}));
  Random random(0x5eed0024);
  EntryCount count;
  for (int i = 0; i < 40; ++i) {
    const Vector camera(Vector(2.5f, 2.5f, 0) + Vector(1.49 * random.in_cube()));
    compare_entries(scene, camera, {2, 3, 0.5f}, directions_to(scene, camera, 60, random), count);
  }
  EXPECT_GT(count.asked, 500);
}

TEST(ClosedParts, ARayTellsWhoIsInTheHoleOfARing) {
  for (const Mesh& mesh : {ring(), inside_out(ring())}) {
    const Scene scene(joined(mesh, box({-0.25f, -0.25f, -0.25f}, {0.25f, 0.25f, 0.25f})));
    const ClosedParts parts(scene, Executor(1));
    using Flags = std::vector<std::uint8_t>;
    EXPECT_EQ(parts.outside(scene, {0.5f, 0, 0}), (Flags{1, 1}));
    EXPECT_EQ(parts.outside(scene, {0, 0, 0}), (Flags{1, 0}));
    EXPECT_EQ(parts.outside(scene, {2, 0, 0}), (Flags{0, 1}));
    EXPECT_EQ(parts.outside(scene, {1, 0, 0}), (Flags{0, 1}));
    EXPECT_EQ(parts.outside(scene, {0.5f, 0.5f, 1}), (Flags{1, 1}));  // in the plane of the top
    Random random(0x5eed0025);
    EntryCount count;
    for (int i = 0; i < 40; ++i) {
      const Vector camera(random.in_cube()), light(random.in_cube());
      compare_entries(scene, camera, light, directions_to(scene, camera, 60, random), count);
    }
    EXPECT_GT(count.asked, 200);
    EXPECT_GT(count.skipped, 20);
  }
}

/// The winding number by solid angles (Van Oosterom and Strackee 1983): not exact, but not by rays either.
double winding_number(const Scene& scene, const Vector& point) {
  double sum = 0;
  for (const std::uint32_t face : scene.kept_faces()) {
    std::array<DVector, 3> to;
    for (int i = 0; i < 3; ++i) to[i] = DVector(scene.mesh().vertex(face, i)) - DVector(point);
    const auto [a, b, c] = to;
    const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
    sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                      x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
  }
  return sum / (2 * M_PI);
}

/// A closed solid: a ball or a box, as it is, inside out or crushed; perhaps cut into triangles of their own.
Mesh random_solid(Random& random) {
  const DVector a = random.in_cube(), b = random.in_cube();
  Mesh solid = random.chance(0.5)
                   ? test_scenes::uv_sphere(random.between(3, 8), random.between(2, 6), a, random.between(0.2, 1.5))
                   : box(Vector(-2.0 + a), Vector(0.5 + b));
  if (random.chance(0.3)) solid = inside_out(solid);
  if (random.chance(0.3)) {
    for (Vector& v : solid.positions) v = Vector(2.0 * random.in_cube());
  }
  if (random.chance(0.2)) {  // faces without area, parts that touch or share planes
    for (Vector& v : solid.positions) v = glm::round(v);
  }
  return solid;
}

TEST(ClosedParts, RaysAgreeWithSolidAngles) {
  constexpr std::uint64_t kSeed = 0x5eed0026;
  Random random(kSeed);
  int inside = 0, outside = 0, undecided = 0;
  for (int round = 0; round < 400; ++round) {
    const Scene scene(random_solid(random));
    const ClosedParts parts(scene, Executor(1));
    if (parts.closed_count() != 1) continue;
    for (int i = 0; i < 50; ++i) {
      const Vector point =
          random.chance(0.3) ? Vector(glm::round(2.0 * random.in_cube())) : Vector(2.0 * random.in_cube());
      const bool is_outside = parts.outside(scene, point)[0] != 0;
      const double winding = winding_number(scene, point);
      const bool is_off = std::fabs(winding - std::round(winding)) < 1e-6;  // or else on the surface
      if (is_outside) {
        ASSERT_TRUE(is_off && std::round(winding) == 0) << round << ": " << test_queries::text(point);
      }
      undecided += !is_outside && is_off && std::round(winding) == 0;
      inside += !is_outside;
      outside += is_outside;
    }
  }
  std::printf("seed %#llx: %d outside, %d not, %d of these are\n", static_cast<unsigned long long>(kSeed), outside,
              inside, undecided);
  EXPECT_GT(outside, 5000);
  EXPECT_GT(inside, 1000);
  EXPECT_LT(undecided, 100);  // points of the surface's planes and edges, and rays that met no luck
}

// Closed and open ones, in each other and through each other, with duplicates, seen from anywhere.
TEST(ClosedParts, EntriesOfClosedPartsMayBeSkipped) {
  constexpr std::uint64_t kSeed = 0x5eed0027;
  Random random(kSeed);
  EntryCount count;
  for (int round = 0; round < 300; ++round) {
    Mesh mesh;
    for (int i = random.between(1, 4); i > 0; --i) {
      Mesh solid = random_solid(random);
      const int a_face = random.below(static_cast<int>(solid.face_count()));
      if (random.chance(0.15)) solid.triangles.erase(solid.triangles.begin() + a_face);
      if (random.chance(0.15)) solid.triangles.push_back(solid.triangles[a_face / 2]);
      if (random.chance(0.15)) std::swap(solid.triangles[a_face / 3][0], solid.triangles[a_face / 3][1]);
      mesh = joined(mesh, solid);
    }
    if (random.chance(0.2)) mesh = joined(mesh, box({-4, -4, -2}, {4, 4, -1}));
    const Scene scene(mesh);
    if (scene.kept_faces().empty()) continue;
    for (int i = 0; i < 4; ++i) {
      const Vector camera = random.chance(0.5) ? outside(scene, random) : Vector(2.0 * random.in_cube());
      const Vector light = random.chance(0.5) ? outside(scene, random) : Vector(2.0 * random.in_cube());
      compare_entries(scene, camera, light, directions_to(scene, camera, 100, random), count);
      if (HasFatalFailure()) return;
    }
  }
  std::printf("seed %#llx: %d points asked, %d blocked, %d also by an entry that was skipped\n",
              static_cast<unsigned long long>(kSeed), count.asked, count.blocked, count.skipped);
  EXPECT_GT(count.asked, 10000);
  EXPECT_GT(count.skipped, 3000);
}

}  // namespace
