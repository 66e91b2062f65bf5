#include "scene/closed_parts.h"

#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "parallel/executor.h"
#include "scene/closed_edges.h"
#include "scene/welded.h"
#include "support/random.h"
#include "support/scenes.h"

namespace facemap {
namespace {

using test_scenes::box;
using test_scenes::joined;

std::size_t closed_count(const Scene& scene) { return ClosedParts(scene, Executor(1)).closed_count(); }

/// The faces that may be skipped for a camera and a light far away, as ones.
std::vector<std::uint8_t> closed_faces(const Scene& scene, int threads = 1) {
  const Vector far = Vector(3e3f, 4e3f, 5e3f);
  std::vector<std::uint8_t> closed = ClosedParts(scene, Executor(threads)).skippable_entries(scene, far, far);
  if (closed.empty()) closed.resize(scene.face_count(), 0);
  return closed;
}

Mesh without_face(Mesh mesh, int face) {
  mesh.triangles.erase(mesh.triangles.begin() + face);
  return mesh;
}

Mesh inside_out(Mesh mesh) {
  for (Corners& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Each triangle with vertices of its own.
Mesh unshared(const Mesh& mesh) {
  Mesh apart;
  for (std::size_t i = 0; i < mesh.face_count(); ++i) {
    test_scenes::add_triangle(apart, mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2));
  }
  return apart;
}

/// The slow and plain way: the faces of each part whose edges cancel.
std::vector<std::uint8_t> closed_faces_by_maps(const Scene& scene) {
  std::vector<std::uint32_t> set(scene.mesh().positions.size());
  std::iota(set.begin(), set.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (set[v] != v) v = set[v] = set[set[v]];
    return v;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  std::set<std::uint32_t> open;
  std::vector<std::uint8_t> closed(scene.face_count(), 0);
  const auto corners_of = [&](std::size_t i) { return welded_corners(scene.mesh().triangles[i], scene.welded()); };
  for (std::size_t i = 0; i < scene.face_count(); ++i) {
    const Corners c = corners_of(i);
    if (!has_edges(scene, i, c)) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
      set[find(a)] = find(b);
    }
  }
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) open.insert(find(edge.first));
  }
  for (std::size_t i = 0; i < scene.face_count(); ++i) closed[i] = !open.contains(find(corners_of(i)[0]));
  return closed;
}

TEST(ClosedParts, AreFoundByTheirEdges) {
  const Mesh one = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(closed_count(Scene(one)), 1u);
  EXPECT_EQ(closed_count(Scene(inside_out(one))), 1u);
  EXPECT_EQ(closed_count(Scene(unshared(one))), 1u);  // welded by position
  EXPECT_EQ(closed_count(Scene(joined(one, box({2, -1, -1}, {3, 1, 1})))), 2u);
  EXPECT_EQ(closed_count(Scene(joined(one, box({-3, -3, -3}, {3, 3, 3})))), 2u);  // nested
  EXPECT_EQ(closed_count(Scene(joined(one, box({0, 0, 0}, {3, 3, 3})))), 2u);     // through each other
  EXPECT_EQ(closed_count(Scene(joined(one, box({1, 1, 1}, {3, 3, 3})))), 1u);     // touching in a vertex: as one
}

TEST(ClosedParts, AFaceLessOrTurnedRoundOpensThem) {
  const Mesh ball = test_scenes::uv_sphere(9, 6, {0, 0, 0}, 2);
  for (int face = 0; face < static_cast<int>(ball.face_count()); ++face) {
    EXPECT_EQ(closed_count(Scene(without_face(ball, face))), 0u);
    Mesh turned = ball;
    std::swap(turned.triangles[face][0], turned.triangles[face][1]);
    EXPECT_EQ(closed_count(Scene(turned)), 0u);
    const Scene beside(joined(box({5, 5, 5}, {6, 6, 6}), without_face(ball, face)));
    const std::vector<std::uint8_t> closed = closed_faces(beside);
    ASSERT_EQ(closed.size(), 12 + ball.face_count() - 1);
    EXPECT_EQ(std::count(closed.begin(), closed.begin() + 12, 1), 12);
    EXPECT_EQ(std::count(closed.begin() + 12, closed.end(), 1), 0);
  }
}

TEST(ClosedParts, DuplicatesDoNotCountButOpposedOnesOpen) {
  Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.push_back(mesh.triangles[3]);
  EXPECT_EQ(closed_count(Scene(mesh)), 1u);
  std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);
  EXPECT_EQ(closed_count(Scene(mesh)), 1u);  // the one of lower id stays
  // A sheet of two faces, back to back: one of them is dropped.
  Mesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(closed_count(Scene(sheet)), 0u);
}

TEST(ClosedParts, FacesWithoutAreaFillGaps) {
  // A tetrahedron of which one face has a vertex on one of its edges: the sliver between is what closes it.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}};
  mesh.triangles = {{0, 2, 4}, {4, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_EQ(closed_count(Scene(mesh)), 0u);
  mesh.triangles.push_back({0, 4, 1});
  const Scene filled(mesh);
  EXPECT_EQ(filled.odd_faces().zero_area, 1);
  EXPECT_EQ(closed_count(filled), 1u);
  // Alone they are no part, even if their edges cancel.
  Mesh slivers;
  slivers.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  slivers.triangles = {{0, 1, 2}, {2, 1, 0}, {0, 0, 1}};
  EXPECT_EQ(closed_count(Scene(slivers)), 0u);
}

TEST(ClosedParts, AnEdgeOfFourFacesIsClosedIfItsDirectionsCancel) {
  const Mesh two = joined(box({-1, -1, -1}, {0, 0, 0}), box({0, 0, -1}, {1, 1, 0}));
  EXPECT_EQ(closed_count(Scene(two)), 1u);
  EXPECT_EQ(closed_count(Scene(joined(box({-1, -1, -1}, {0, 0, 0}), inside_out(box({0, 0, -1}, {1, 1, 0}))))), 1u);
}

TEST(ClosedParts, AgreeWithAMapOfAllEdges) {
  Random random(0x5eed0031);
  int closed_scenes = 0;
  for (int round = 0; round < 300; ++round) {
    Mesh mesh;
    for (int i = random.between(1, 6); i > 0; --i) {
      Mesh solid = test_scenes::uv_sphere(random.between(3, 12), random.between(2, 9), 2.0 * random.in_cube(), 1);
      if (random.chance(0.3)) solid = inside_out(solid);
      if (random.chance(0.3)) solid = without_face(solid, random.below(static_cast<int>(solid.face_count())));
      if (random.chance(0.3)) solid = unshared(solid);
      if (random.chance(0.2)) solid.triangles.push_back(solid.triangles[random.below(3)]);
      if (random.chance(0.2)) {  // onto a grid: faces without area, parts that touch
        for (Vector& v : solid.positions) v = glm::round(v);
      }
      mesh = joined(mesh, solid);
    }
    if (random.chance(0.5)) {
      for (std::size_t i = mesh.triangles.size(); i > 1; --i) {
        std::swap(mesh.triangles[i - 1], mesh.triangles[random.below(static_cast<int>(i))]);
      }
    }
    const Scene scene(mesh);
    const std::vector<std::uint8_t> expected = closed_faces_by_maps(scene), found = closed_faces(scene);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_TRUE(!scene.is_kept(i) || found[i] == expected[i]) << "round " << round << ", face " << i;
    }
    closed_scenes += std::count(found.begin(), found.end(), 1) > 0;
  }
  EXPECT_GT(closed_scenes, 100);
}

// Large enough for several tasks, and in an order in which the windows hold but a part of the edges.
TEST(ClosedParts, AreTheSameInAnyOrderAndForAnyNumberOfThreads) {
  Random random(0x5eed0032);
  const Mesh mesh =
      joined(test_scenes::uv_sphere(200, 200, {0, 0, 0}, 2), test_scenes::uv_sphere(100, 200, {1, 0, 0}, 2));
  for (const Mesh& in_order : {mesh, without_face(mesh, static_cast<int>(mesh.face_count()) - 1)}) {
    Mesh shuffled = in_order;
    for (std::size_t i = shuffled.triangles.size(); i > 1; --i) {
      std::swap(shuffled.triangles[i - 1], shuffled.triangles[random.below(static_cast<int>(i))]);
    }
    for (const Mesh& each : {in_order, shuffled}) {
      const Scene scene(each);
      const std::vector<std::uint8_t> closed = closed_faces(scene);
      EXPECT_EQ(closed, closed_faces_by_maps(scene));
      for (const int threads : {2, 3, 8}) EXPECT_EQ(closed_faces(scene, threads), closed);
    }
  }
}

TEST(ClosedParts, PointsOnTheirBoxAreAskedByARay) {
  const Scene scene(box({-1, -1, -1}, {1, 1, 1}));
  const ClosedParts parts(scene, Executor(1));
  const auto is_outside = [&](const Vector& p) { return parts.outside(scene, p) == std::vector<std::uint8_t>{1}; };
  EXPECT_TRUE(is_outside({0, 0, 1.0000001f}));
  EXPECT_FALSE(is_outside({0.1f, 0.2f, 1}));  // on a face
  EXPECT_FALSE(is_outside({0, 0, 1}));        // on an edge
  EXPECT_FALSE(is_outside({1, 1, 1}));        // on a vertex
  EXPECT_FALSE(is_outside({0.1f, 0.2f, 0.3f}));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(is_outside({nan, 0, 0}));
}

}  // namespace
}  // namespace facemap
