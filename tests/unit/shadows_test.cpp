#include "picture/shadows.h"

#include <facemap/generators.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <variant>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "simd/target.h"
#include "support/oracle.h"
#include "support/queries.h"
#include "support/random.h"
#include "support/scenes.h"

namespace facemap {
namespace {

using test_scenes::Kind;
using test_scenes::TestScene;

using Point = std::variant<TruePoint, GivenPoint>;

bool is_blocked_by(const Scene& scene, std::uint32_t face, int s, const Vector& light, const Point& point) {
  return std::visit([&](const auto& p) { return blocks(triangle_of(scene, face), s, light, p); }, point);
}

bool is_blocked(const Scene& scene, const Vector& light, const Point& point, std::uint32_t own_face) {
  return std::any_of(scene.kept_faces().begin(), scene.kept_faces().end(), [&](std::uint32_t face) {
    return face != own_face && is_blocked_by(scene, face, side(triangle_of(scene, face), light), light, point);
  });
}

// Points of any kind, and the same as clear_blocked takes them.
struct Questions {
  std::vector<Point> points;
  std::vector<std::uint32_t> own_faces;
  std::vector<Triangle> faces_on;  // what GivenPoint::on_face points to
  AskedPoints asked;

  void round(const Vector& reference) {
    std::vector<DVector> places;
    DVector lower(HUGE_VAL), upper(-HUGE_VAL);
    double farthest = 0;
    for (const Point& point : points) {
      const DVector offset = std::visit([&](const auto& p) { return offset_of(reference, p); }, point);
      places.push_back(DVector(reference) + offset);
      lower = glm::min(lower, places.back());
      upper = glm::max(upper, places.back());
      farthest = std::max({farthest, std::fabs(offset.x), std::fabs(offset.y), std::fabs(offset.z)});
    }
    const DVector extent = upper - lower;
    asked = {};
    asked.origin = 0.5 * (lower + upper);
    asked.step = std::max({extent.x, extent.y, extent.z, 0x1p-140}) * 0x1p-31;
    const double size = std::max({std::fabs(reference.x), std::fabs(reference.y), std::fabs(reference.z), 0.0f});
    asked.error = asked.step + 2 * kDirectionError * farthest + 0x1p-50 * (size + farthest);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const DVector q = (places[i] - asked.origin) / asked.step;
      asked.x.push_back(static_cast<std::int32_t>(std::nearbyint(q.x)));
      asked.y.push_back(static_cast<std::int32_t>(std::nearbyint(q.y)));
      asked.z.push_back(static_cast<std::int32_t>(std::nearbyint(q.z)));
      asked.faces.push_back(own_faces[i]);
      asked.samples.push_back(static_cast<std::uint32_t>(i));
    }
  }

  static DVector offset_of(const Vector& from, const TruePoint& p) { return offset_from(from, p, ray_parameter(p)); }
  static DVector offset_of(const Vector& from, const GivenPoint& p) { return offset_from(from, p); }
};

struct Answer {
  std::vector<std::uint8_t> masks;
  Counters counters;
};

Answer ask(const Scene& scene, const Vector& light, const Questions& questions, int bit, std::size_t stride,
           const std::uint8_t* skip_entries = nullptr) {
  Answer answer;
  answer.masks.assign(questions.points.size() * stride, 0xff);
  ShadowScratch scratch;
  const auto exactly = [&](std::size_t point, std::uint32_t face, int s) {
    EXPECT_NE(face, questions.own_faces[point]);
    EXPECT_EQ(s, side(triangle_of(scene, face), light));
    return is_blocked_by(scene, face, s, light, questions.points[point]);
  };
  clear_blocked(scene, light, questions.asked, {answer.masks.data(), answer.masks.data(), stride, bit}, skip_entries,
                exactly, scratch, &answer.counters);
  return answer;
}

// Every target's masks against `expected`, one bool a point; no other bit may change.
void expect_masks(const Scene& scene, const Vector& light, const Questions& questions,
                  const std::vector<bool>& expected, int bit, const std::uint8_t* skip_entries,
                  const std::string& what) {
  const std::size_t stride = static_cast<std::size_t>(bit) / 8 + 1;
  const simd::Target before = simd::active_target();
  std::uint64_t by_float = 0;
  for (const simd::Target target : simd::supported_targets()) {
    simd::set_active_target(target);
    const Answer answer = ask(scene, light, questions, bit, stride, skip_entries);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      for (std::size_t k = 0; k < stride; ++k) {
        const std::uint8_t all = 0xff;
        const bool is_here = k == static_cast<std::size_t>(bit) / 8;
        const auto due = static_cast<std::uint8_t>(is_here && expected[i] ? all & ~(1u << (bit % 8)) : all);
        wrong += answer.masks[i * stride + k] != due;
      }
    }
    EXPECT_EQ(wrong, 0u) << what << ", target " << name_of(target);
    if (target == simd::Target::Scalar) by_float = answer.counters.by_float;
    EXPECT_EQ(answer.counters.by_float, by_float) << what << ", target " << name_of(target);
  }
  simd::set_active_target(before);
}

// ---- random scenes, aimed points

Questions make_questions(const TestScene& test, const Scene& scene, const oracle::Oracle& oracle, const Vector& camera,
                         const Vector& light, int count, Random& random) {
  Questions questions;
  const oracle::View view = oracle.from(camera);
  questions.faces_on.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const test_queries::LightQuery query = test_queries::make_light_query(test, oracle, view, light, random);
    if (query.is_seen) {
      questions.points.push_back(
          TruePoint{query.seen.origin, query.seen.direction, query.seen.vertices, query.seen.side});
      questions.own_faces.push_back(query.seen.face == kNoFace ? kNoOwnFace
                                                               : static_cast<std::uint32_t>(query.seen.face));
      continue;
    }
    GivenPoint given{query.given};
    std::uint32_t own = kNoOwnFace;
    if (query.on.face != kNoFace) {
      own = static_cast<std::uint32_t>(query.on.face);
      given.on_face = &questions.faces_on.emplace_back(triangle_of(scene, own));
    }
    questions.points.push_back(given);
    questions.own_faces.push_back(own);
  }
  questions.round(camera);
  return questions;
}

std::vector<bool> expected_answers(const Scene& scene, const Vector& light, const Questions& questions) {
  std::vector<bool> expected;
  for (std::size_t i = 0; i < questions.points.size(); ++i) {
    expected.push_back(is_blocked(scene, light, questions.points[i], questions.own_faces[i]));
  }
  return expected;
}

void ask_about(const TestScene& test, const Vector& camera, const Vector& light, int count, Random& random) {
  const Scene scene(test.mesh);
  const oracle::Oracle oracle(scene.mesh());
  const Questions questions = make_questions(test, scene, oracle, camera, light, count, random);
  const std::vector<bool> expected = expected_answers(scene, light, questions);
  expect_masks(scene, light, questions, expected, random.below(20), nullptr,
               test.name + ", light " + test_queries::text(light));
}

TEST(Shadows, EqualAskingEveryFaceOnRandomScenes) {
  const std::uint64_t seed = 20240717;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int i = 0; i < 1500 && !HasFailure(); ++i) {
    const TestScene test = test_scenes::make_any_scene(random, 120);
    const Vector camera = make_origin(test, random);
    const Vector light = random.chance(0.2) ? camera : make_origin(test, random);
    ask_about(test, camera, light, random.between(1, 60), random);
  }
}

TEST(Shadows, EqualAskingEveryFaceForLightsFarAway) {
  const std::uint64_t seed = 77;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    const TestScene test = test_scenes::make_any_scene(random, 80);
    const double distance = test.radius * std::pow(2.0, random.between(0.0, 40.0));
    const Vector light(DVector(test.centre) + distance * random.direction());
    if (!std::isfinite(light.x) || !std::isfinite(light.y) || !std::isfinite(light.z)) continue;
    ask_about(test, make_origin(test, random), light, 40, random);
  }
}

TEST(Shadows, EqualAskingEveryFaceForManyPointsOfOneScene) {
  const std::uint64_t seed = 5;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (const Kind kind : {Kind::Patch, Kind::Soup, Kind::Ball, Kind::Boxes, Kind::Shell}) {
    const TestScene test = make_scene(kind, 300, random);
    for (int i = 0; i < 3 && !HasFailure(); ++i) {
      ask_about(test, make_origin(test, random), make_origin(test, random), 3000, random);
    }
  }
}

// ---- closed solids: exit faces are enough for points strictly inside their faces

TEST(Shadows, EntryFacesOfSolidsMayBeLeftOut) {
  const std::uint64_t seed = 11;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const TestScene test = make_scene(random.chance(0.5) ? Kind::Boxes : Kind::Ball, 150, random);
    const Scene scene(test.mesh);
    const oracle::Oracle oracle(scene.mesh());
    if (scene.kept_faces().size() != scene.face_count()) continue;  // a duplicate face opens a solid
    const auto outside = [&] { return Vector(DVector(test.centre) + 12 * test.radius * random.direction()); };
    const Vector camera = outside(), light = outside();
    const oracle::View view = oracle.from(camera);
    Questions questions;
    for (int k = 0; k < 400; ++k) {
      const Vector d(DVector(test.centre) + test.radius * random.in_cube() - DVector(camera));
      const oracle::Hit hit = view.nearest(d);
      if (hit.face == kNoFace || !hit.strictly_inside || hit.tied) continue;
      const auto face = static_cast<std::uint32_t>(hit.face);
      if (side(triangle_of(scene, face), light) * hit.side <= 0) continue;
      questions.points.push_back(TruePoint{camera, d, triangle_of(scene, face), hit.side});
      questions.own_faces.push_back(face);
    }
    if (questions.points.empty()) continue;
    questions.round(camera);
    const std::vector<std::uint8_t> skip(scene.face_count(), 1);
    expect_masks(scene, light, questions, expected_answers(scene, light, questions), 3, skip.data(), test.name);
  }
}

// ---- ends

TEST(Shadows, PointsWhoseBitIsNotSetStayAsTheyAre) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1});
  const Scene scene(mesh);
  AskedPoints points;
  points.step = 0x1p-20;
  points.error = 0x1p-40;
  for (const std::int32_t x : {0, 3 << 20}) {
    points.x.push_back(x);
    points.y.push_back(-(1 << 20));
    points.z.push_back(0);
    points.faces.push_back(kNoOwnFace);
    points.samples.push_back(0);
  }
  std::vector<std::uint8_t> masks{0x01, 0x01};
  ShadowScratch scratch;
  const auto never = [](std::size_t, std::uint32_t, int) { return false; };
  clear_blocked(scene, {0, 1, 0}, points, {masks.data(), masks.data(), 1, 1}, nullptr, never, scratch);
  EXPECT_EQ(masks, (std::vector<std::uint8_t>{0x01, 0x01}));
  clear_blocked(scene, {0, 1, 0}, points, {masks.data(), masks.data(), 1, 0}, nullptr, never, scratch);
  EXPECT_EQ(masks, (std::vector<std::uint8_t>{0x00, 0x01}));
  EXPECT_GT(scratch.memory_bytes(), 0u);
}

TEST(Shadows, NoPointsAskNothing) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1});
  const Scene scene(mesh);
  ShadowScratch scratch;
  Counters counters;
  const auto never = [](std::size_t, std::uint32_t, int) { return false; };
  // There is no memory to point into, not even to its second byte.
  clear_blocked(scene, {0, 1, 0}, AskedPoints(), {nullptr, nullptr, 2, 9}, nullptr, never, scratch, &counters);
  EXPECT_EQ(counters.by_float, 0u);
}

TEST(Shadows, OwnFaceNeverBlocks) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1});
  const Scene scene(mesh);
  AskedPoints points;
  points.step = 0x1p-20;
  points.error = 0x1p-40;
  points.x = {0};
  points.y = {0};
  points.z = {0};
  points.faces = {0};
  points.samples = {0};
  std::vector<std::uint8_t> masks{0x01};
  ShadowScratch scratch;
  clear_blocked(
      scene, {0, 1, 0}, points, {masks.data(), masks.data(), 1, 0}, nullptr,
      [](std::size_t, std::uint32_t, int) { return true; }, scratch);
  EXPECT_EQ(masks[0], 0x01);
}

}  // namespace
}  // namespace facemap
