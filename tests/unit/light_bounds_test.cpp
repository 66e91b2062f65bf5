#include "picture/light_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "picture/decide_points.h"
#include "picture/kept_bounds.h"
#include "scene/closed_parts.h"
#include "simd/target.h"
#include "support/random.h"
#include "support/scenes.h"

namespace facemap {
namespace {

using test_scenes::Kind;
using test_scenes::TestScene;

// Of any kind but Wild.
TestScene make_test_scene(int fewest_faces, int most_faces, Random& random) {
  const auto kind = static_cast<Kind>(random.below(test_scenes::kKindCount - 1));
  return test_scenes::make_scene(kind, random.between(fewest_faces, most_faces), random);
}

// Well outside the scene.
Vector make_light(const TestScene& test, Random& random) {
  return Vector(DVector(test.centre) +
                test.radius * std::exp2(random.between(1.5, 6.0)) * normalized(DVector(random.direction())));
}

std::optional<LightBounds> find_bounds(const Scene& scene, const Vector& light) {
  return LightBounds::find(scene, light, nullptr, find_face_neighbours(scene));
}

bool is_blocked(const Scene& scene, const Vector& light, const Vector& point) {
  const auto& faces = scene.kept_faces();
  return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t face) {
    const Triangle triangle = triangle_of(scene, face);
    return blocks(triangle, side(triangle, light), light, GivenPoint{point});
  });
}

// Anywhere about the scene, on a face up to rounding, or near one.
Vector make_point(const TestScene& test, Random& random) {
  const Mesh& mesh = test.mesh;
  DVector point = DVector(test.centre) + 1.3 * test.radius * DVector(random.direction()) * random.between(0.0, 1.0);
  if (random.chance(0.7)) {
    const auto face = static_cast<std::size_t>(random.below(static_cast<int>(mesh.face_count())));
    const double s = random.between(0.0, 1.0), t = random.between(0.0, 1.0 - s);
    const DVector a(mesh.vertex(face, 0)), b(mesh.vertex(face, 1)), c(mesh.vertex(face, 2));
    point = a + s * (b - a) + t * (c - a);
    if (random.chance(0.5)) point += test.radius * std::exp2(random.between(-20.0, -3.0)) * DVector(random.direction());
  }
  return Vector(point);
}

std::vector<Vector> make_points(int count, const TestScene& test, Random& random) {
  std::vector<Vector> points;
  for (int i = 0; i < count; ++i) points.push_back(make_point(test, random));
  return points;
}

AskedPoints asked(const TestScene& test, const std::vector<Vector>& points) {
  AskedPoints result;
  result.origin = DVector(test.centre);
  result.step = test.radius * 0x1p-26;
  result.error = result.step;
  for (const Vector& p : points) {
    const DVector q = (DVector(p) - result.origin) / result.step;
    result.x.push_back(static_cast<std::int32_t>(std::nearbyint(q.x)));
    result.y.push_back(static_cast<std::int32_t>(std::nearbyint(q.y)));
    result.z.push_back(static_cast<std::int32_t>(std::nearbyint(q.z)));
    result.faces.push_back(kNoOwnFace);
  }
  return result;
}

struct Decisions {
  std::vector<std::uint8_t> lit;  // cleared where dark
  std::vector<std::uint32_t> open;
  const std::vector<std::uint32_t>* faces;  // that may block those
};

Decisions decide(const LightBounds& bounds, const Vector& light, const AskedPoints& points, int bit,
                 std::size_t stride) {
  std::vector<std::uint8_t> masks(points.size() * stride, 0xff);
  const std::vector<std::uint8_t> before = masks;
  DecidedPoints work;
  Counters counters;
  decide_points(bounds, light, points, {before.data(), masks.data(), stride, bit}, work, counters, false);
  EXPECT_EQ(counters.by_float, points.size() - work.numbers.size());
  Decisions decisions;
  decisions.open = work.numbers;
  decisions.faces = work.faces;
  EXPECT_EQ(work.open.size(), work.numbers.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto at = i * stride + static_cast<std::size_t>(bit) / 8;
    EXPECT_EQ(masks[at] | 1 << bit % 8, 0xff) << "other lights' bits stay";
    decisions.lit.push_back(masks[at] >> (bit % 8) & 1);
  }
  return decisions;
}

// What they decide is so.
TEST(LightBounds, EqualTheExactAnswer) {
  constexpr std::uint64_t kSeed = 0x5eed0075;
  std::printf("seed 0x%llx\n", (unsigned long long)kSeed);
  Random random(kSeed);
  std::size_t all = 0, lit = 0, dark = 0;
  for (int round = 0; round < 120; ++round) {
    const TestScene test = make_test_scene(4, 400, random);
    const Scene scene(test.mesh);
    const Vector light = make_light(test, random);
    const auto bounds = find_bounds(scene, light);
    if (!bounds) continue;
    const std::vector<Vector> points = make_points(300, test, random);
    const AskedPoints questions = asked(test, points);
    const Decisions decisions = decide(*bounds, light, questions, round % 11, round % 11 < 8 && round % 2 == 0 ? 1 : 2);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ++all;
      if (std::binary_search(decisions.open.begin(), decisions.open.end(), i)) {
        EXPECT_EQ(decisions.lit[i], 1);
        continue;
      }
      (decisions.lit[i] != 0 ? lit : dark) += 1;
      ASSERT_EQ(decisions.lit[i] == 0, is_blocked(scene, light, points[i]))
          << test.name << " round " << round << " point " << points[i].x << ' ' << points[i].y << ' ' << points[i].z;
    }
  }
  std::printf("%zu points, %zu lit, %zu dark for certain\n", all, lit, dark);
  EXPECT_GT(all, 20000u);
  EXPECT_GT(lit, all / 10);
  EXPECT_GT(dark, all / 10);
}

// The side of a large sheet that a light does not see is dark but for its rim, in spite of a second sheet behind all.
TEST(LightBounds, KnowThatASheetCastsAShadow) {
  Mesh mesh;
  constexpr int kSide = 8;
  for (const float height : {1.0f, -5.0f}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i <= kSide; ++i) {
      for (int j = 0; j <= kSide; ++j) mesh.positions.push_back(Vector(i - kSide / 2, height, j - kSide / 2));
    }
    for (std::uint32_t i = 0; i < kSide; ++i) {
      for (std::uint32_t j = 0; j < kSide; ++j) {
        const std::uint32_t a = first + i * (kSide + 1) + j, b = a + kSide + 1;
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  const Scene scene(mesh);
  const Vector light(0, 30, 0);
  const auto bounds = find_bounds(scene, light);
  ASSERT_TRUE(bounds);
  TestScene test;
  test.radius = 8;
  const std::vector<Vector> points = {{0.3f, 0, 0.2f}, {-2.1f, -4, 3.3f}, {0, 2, 0}, {3.5f, -4.9f, 0}, {0, -6, 0}};
  const Decisions decisions = decide(*bounds, light, asked(test, points), 0, 1);
  EXPECT_EQ(decisions.lit, (std::vector<std::uint8_t>{0, 0, 1, 0, 0}));
  EXPECT_TRUE(decisions.open.empty()) << "point " << decisions.open[0];
}

// The bounds' decisions and the answers of the lists, one byte a point: 1 where it is lit. Points that neither places
// are left lit; `listed` counts those that asked lists.
std::vector<std::uint8_t> ask_all(const Scene& scene, const LightBounds& bounds, const Vector& light,
                                  const AskedPoints& questions, const std::vector<Vector>& points,
                                  std::vector<std::uint32_t>& listed, Counters& counters) {
  std::vector<std::uint8_t> lit(points.size(), 1);
  const std::vector<std::uint8_t> before = lit;
  const MaskBit mask{before.data(), lit.data(), 1, 0};
  DecidedPoints work;
  decide_points(bounds, light, questions, mask, work, counters);
  listed = work.listed.numbers;
  if (listed.empty()) return lit;
  const BlocksExactly blocks_exactly = [&](std::size_t point, std::uint32_t face, int face_side) {
    return blocks(triangle_of(scene, face), face_side, light, GivenPoint{points[point]});
  };
  ask_lists(scene, light, *bounds.lists(), questions, mask, blocks_exactly, work.listed, work.dark, counters);
  return lit;
}

// Points that the bounds leave open, asked of the lists, on faces, next to them and at edges and corners.
TEST(LightBounds, ListsEqualTheExactAnswer) {
  constexpr std::uint64_t kSeed = 0x5eed007b;
  std::printf("seed 0x%llx\n", (unsigned long long)kSeed);
  Random random(kSeed);
  std::size_t listed = 0, blocked = 0, halved = 0;
  Counters counters;
  for (int round = 0; round < 250; ++round) {
    const TestScene test = make_test_scene(40, 900, random);
    const Scene scene(test.mesh);
    const Vector light = make_light(test, random);
    const auto bounds = find_bounds(scene, light);
    if (!bounds || bounds->lists() == nullptr) continue;
    halved += bounds->lists()->size() != bounds->texels().size;
    std::vector<Vector> points = make_points(300, test, random);
    for (int i = 0; i < 30; ++i) {
      const auto face = static_cast<std::size_t>(random.below(static_cast<int>(test.mesh.face_count())));
      const DVector a(test.mesh.vertex(face, 0)), b(test.mesh.vertex(face, 1));
      const DVector at = random.chance(0.3) ? a : (a + b) / 2.0;
      points.push_back(Vector(DVector(light) + random.between(0.9, 1.3) * (at - DVector(light))));
      points.push_back(test.mesh.vertex(face, 2));
    }
    const AskedPoints questions = asked(test, points);
    std::vector<std::uint32_t> numbers;
    const std::vector<std::uint8_t> lit = ask_all(scene, *bounds, light, questions, points, numbers, counters);
    for (const std::uint32_t i : numbers) {
      ++listed;
      blocked += lit[i] == 0;
      ASSERT_EQ(lit[i] == 0, is_blocked(scene, light, points[i]))
          << test.name << " round " << round << " point " << points[i].x << ' ' << points[i].y << ' ' << points[i].z;
    }
  }
  std::printf("%zu points listed, %zu blocked; %llu decided by float32, %llu by doubles, %llu exactly; %zu halved\n",
              listed, blocked, (unsigned long long)counters.by_float, (unsigned long long)counters.by_double,
              (unsigned long long)counters.by_exact, halved);
  EXPECT_GT(listed, 10000u);
  EXPECT_GT(blocked, 1000u);
  EXPECT_GT(halved, 5u);
  EXPECT_GT(counters.by_double, 100u);
}

TEST(LightBounds, AreTheSameOnEveryTarget) {
  Random random(0x5eed0076);
  const TestScene test = test_scenes::make_scene(Kind::Patch, 300, random);
  const Scene scene(test.mesh);
  const Vector light(DVector(test.centre) + DVector(1, 3, 2) * test.radius);
  const std::vector<Vector> points = make_points(3001, test, random);
  std::vector<Decisions> all;
  std::vector<std::uint64_t> by_float, by_exact;
  for (const simd::Target target : simd::supported_targets()) {
    simd::set_active_target(target);
    const auto bounds = find_bounds(scene, light);
    ASSERT_TRUE(bounds);
    ASSERT_TRUE(bounds->lists());
    const AskedPoints questions = asked(test, points);
    all.push_back(decide(*bounds, light, questions, 3, 1));
    Counters counters;
    std::vector<std::uint32_t> numbers;
    all.back().lit = ask_all(scene, *bounds, light, questions, points, numbers, counters);
    EXPECT_FALSE(numbers.empty());
    by_float.push_back(counters.by_float);
    by_exact.push_back(counters.by_exact);
  }
  simd::set_active_target(simd::supported_targets().back());
  EXPECT_FALSE(all[0].open.empty());
  EXPECT_EQ(by_float, std::vector<std::uint64_t>(all.size(), by_float[0]));
  EXPECT_EQ(by_exact, std::vector<std::uint64_t>(all.size(), by_exact[0]));
  for (const Decisions& decisions : all) {
    EXPECT_EQ(decisions.open, all[0].open);
    EXPECT_EQ(decisions.lit, all[0].lit);
  }
}

// Where entry faces of closed parts may be left out: lit means that no other face blocks a point, and what is listed
// has a face that blocks each open point that one of the others blocks.
TEST(LightBounds, LeaveOutEntryFacesOfClosedPartsAlone) {
  constexpr std::uint64_t kSeed = 0x5eed0079;
  std::printf("seed 0x%llx\n", (unsigned long long)kSeed);
  Random random(kSeed);
  std::size_t lit = 0, dark = 0, listed = 0, hidden = 0;
  for (int round = 0; round < 100; ++round) {
    TestScene test = make_test_scene(4, 60, random);
    const DVector middle = DVector(test.centre) + 0.7 * test.radius * random.in_cube();
    test.mesh = test_scenes::joined(
        test_scenes::geodesic_sphere(2, middle, test.radius * std::exp2(random.between(-5.0, 0.0))), test.mesh);
    const Scene scene(test.mesh);
    const ClosedParts closed(scene, Executor(1));
    const Vector light(DVector(test.centre) + test.radius * std::exp2(random.between(1.5, 4.0)) * random.direction());
    const std::vector<std::uint8_t> skips =
        closed.skippable_entries(scene, std::vector<std::uint8_t>(closed.closed_count(), 1), light);
    if (skips.empty()) continue;
    const auto bounds = LightBounds::find(scene, light, skips.data(), find_face_neighbours(scene), false);
    if (!bounds) continue;
    const std::vector<Vector> points = make_points(200, test, random);
    const Decisions decisions = decide(*bounds, light, asked(test, points), 0, 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool is_hidden = false, is_by_others = false, is_by_listed = false;
      for (const std::uint32_t face : scene.kept_faces()) {
        const Triangle triangle = triangle_of(scene, face);
        const int face_side = side(triangle, light);
        if (!blocks(triangle, face_side, light, GivenPoint{points[i]})) continue;
        is_hidden = true;
        if (face_side < 0 && skips[face] != 0) continue;
        is_by_others = true;
        is_by_listed = is_by_listed || decisions.faces == nullptr ||
                       std::binary_search(decisions.faces->begin(), decisions.faces->end(), face);
      }
      if (std::binary_search(decisions.open.begin(), decisions.open.end(), i)) {
        ASSERT_EQ(is_by_listed, is_by_others) << test.name << " round " << round << " point " << i;
        listed += decisions.faces != nullptr;
      } else if (decisions.lit[i] != 0) {
        ASSERT_FALSE(is_by_others) << test.name << " round " << round << " point " << i;
        ++lit;
      } else {
        ASSERT_TRUE(is_hidden) << test.name << " round " << round << " point " << i;
        ++dark;
      }
      hidden += is_hidden;
    }
  }
  std::printf("%zu lit, %zu dark for certain, %zu open with a list, %zu blocked\n", lit, dark, listed, hidden);
  EXPECT_GT(lit, 1000u);
  EXPECT_GT(dark, 1000u);
  EXPECT_GT(listed, 1000u);
}

// Else all points that are left open would ask all faces.
TEST(KeptBounds, HaveListsOnlyWhereTheyCanBeAsked) {
  Random random(0x5eed007c);
  const TestScene test = test_scenes::make_scene(Kind::Patch, 300, random);
  for (const float factor : {1.0f, 0x1p40f}) {
    const Scene scene(test_scenes::scaled(test.mesh, factor));
    const Vector light(double{factor} * (DVector(test.centre) + DVector(1, 3, 2) * test.radius));
    KeptBounds kept;
    kept.make(scene, {light}, nullptr, {}, Executor(1));
    const LightBounds* bounds = kept.of(0, {});
    ASSERT_NE(bounds, nullptr);
    EXPECT_EQ(bounds->lists() != nullptr, factor == 1);
  }
}

TEST(LightBounds, AreNotMadeForALightAmongTheFaces) {
  Random random(0x5eed0077);
  const TestScene test = test_scenes::make_scene(Kind::Shell, 40, random);
  const Scene scene(test.mesh);
  EXPECT_FALSE(find_bounds(scene, test.centre));
}

TEST(LightBounds, AreNotMadeOfAPileOfLargeFaces) {
  Mesh mesh;
  for (int i = 0; i < 2000; ++i) {
    const float height = 0.001f * static_cast<float>(i);
    test_scenes::add_triangle(mesh, {-4, height, -4}, {4, height, -4}, {0, height, 4});
  }
  const Scene scene(mesh);
  EXPECT_FALSE(find_bounds(scene, {0, 30, 0}));
  mesh.positions.resize(3 * 20);
  mesh.triangles.resize(20);
  const Scene few(mesh);
  EXPECT_TRUE(find_bounds(few, {0, 30, 0}));
}

}  // namespace
}  // namespace facemap
