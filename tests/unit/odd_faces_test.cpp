#include "scene/odd_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "math/exact_sign.h"
#include "parallel/executor.h"
#include "support/random.h"

namespace facemap {
namespace {

TEST(OddFaces, WeldsByValue) {
  const Executor executor(1);
  EXPECT_EQ(weld({{0, 1, 2}, {-0.0f, 1, 2}, {0, 1, 2.0000002f}, {0, 1, 2}}, executor),
            (std::vector<std::uint32_t>{0, 0, 2, 0}));
  EXPECT_TRUE(weld({}, executor).empty());
  EXPECT_TRUE(weld({{0, 1, 2}, {0, 1, 2.0000002f}}, executor).empty());  // all differ
}

OddFaces find_odd_faces(const Mesh& mesh, std::vector<std::uint8_t>& kept, int threads = 1) {
  const Executor executor(threads);
  return find_odd_faces(mesh, weld(mesh.positions, executor), executor, kept);
}

Mesh square_of_four() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-0.0f, 0, 0}, {0.5f, 0, 0}};
  return mesh;
}

TEST(OddFaces, EachKindIsCounted) {
  Mesh mesh = square_of_four();
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 0, 4}, {0, 5, 1}, {1, 1, 2}, {2, 1, 4}, {3, 0, 2}};
  std::vector<std::uint8_t> kept;
  const OddFaces odd = find_odd_faces(mesh, kept);
  EXPECT_EQ(odd.zero_area, 2);  // two vertices at one place; three on a line
  EXPECT_EQ(odd.repeated_vertex, 1);
  EXPECT_EQ(odd.duplicate, 2);  // by value, in any order
  EXPECT_EQ(kept, (std::vector<std::uint8_t>{1, 1, 0, 0, 0, 0, 0}));
}

TEST(OddFaces, ZeroAreaIsExact) {
  // Collinear as decimals, but not as floats; and a sliver whose area vanishes in double precision.
  Mesh mesh;
  mesh.positions = {{0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}, {0.7f, 0.8f, 0.9f}, {1, 2, 3},     {2, 4, 6},
                    {3, 6, 9},          {1e8f, 1e8f, 0},    {1e-8f, 1e-8f, 0},  {0, 1e-30f, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  std::vector<std::uint8_t> kept;
  EXPECT_EQ(find_odd_faces(mesh, kept).zero_area, 1);
  EXPECT_EQ(kept, (std::vector<std::uint8_t>{1, 0, 1}));
}

TEST(OddFaces, AgreesWithComparingAll) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Mesh mesh;
    for (int i = 0; i < 30; ++i) {
      mesh.positions.push_back(Vector(random.below(3), random.chance(0.2) ? -0.0f : 0.0f, random.below(3)));
    }
    for (int i = 0; i < 150; ++i) {
      mesh.triangles.push_back({static_cast<std::uint32_t>(random.below(30)),
                                static_cast<std::uint32_t>(random.below(30)),
                                static_cast<std::uint32_t>(random.below(30))});
    }
    OddFaces expected;
    std::vector<std::uint8_t> kept, expected_kept;
    std::vector<std::vector<std::vector<float>>> seen;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Corners& c = mesh.triangles[i];
      std::vector<std::vector<float>> place;
      for (int k = 0; k < 3; ++k) place.push_back({mesh.vertex(i, k).x, 0.0f, mesh.vertex(i, k).z});
      std::sort(place.begin(), place.end());
      bool is_kept = false;
      if (c[0] == c[1] || c[1] == c[2] || c[0] == c[2]) {
        ++expected.repeated_vertex;
      } else if (is_degenerate(mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2))) {
        ++expected.zero_area;
      } else if (std::find(seen.begin(), seen.end(), place) != seen.end()) {
        ++expected.duplicate;
      } else {
        is_kept = true;
        seen.push_back(place);
      }
      expected_kept.push_back(is_kept);
    }
    const OddFaces odd = find_odd_faces(mesh, kept);
    EXPECT_EQ(odd.repeated_vertex, expected.repeated_vertex);
    EXPECT_EQ(odd.zero_area, expected.zero_area);
    EXPECT_EQ(odd.duplicate, expected.duplicate);
    EXPECT_EQ(kept, expected_kept);
  }
}

TEST(OddFaces, AreTheSameForAnyNumberOfThreads) {
  Random random(7);
  Mesh mesh;
  for (int i = 0; i < 200'000; ++i) {
    mesh.positions.push_back(Vector(random.below(40), random.below(40), random.below(40)));
  }
  const int count = static_cast<int>(mesh.positions.size());
  for (int i = 0; i < 300'000; ++i) {
    mesh.triangles.push_back({static_cast<std::uint32_t>(random.below(count)),
                              static_cast<std::uint32_t>(random.below(count)),
                              static_cast<std::uint32_t>(random.below(count))});
    if (random.chance(0.1)) mesh.triangles.push_back(mesh.triangles[random.below(i + 1)]);
  }
  std::vector<std::uint8_t> kept, kept_by_more;
  const OddFaces odd = find_odd_faces(mesh, kept);
  EXPECT_GT(odd.duplicate, 20'000);
  EXPECT_GT(odd.zero_area, 10);
  for (const int threads : {2, 3, 8}) {
    const OddFaces by_more = find_odd_faces(mesh, kept_by_more, threads);
    EXPECT_EQ(by_more.zero_area, odd.zero_area);
    EXPECT_EQ(by_more.repeated_vertex, odd.repeated_vertex);
    EXPECT_EQ(by_more.duplicate, odd.duplicate);
    EXPECT_EQ(kept_by_more, kept);
  }
}

}  // namespace
}  // namespace facemap
