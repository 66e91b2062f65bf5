// Which points are visible from a point, on hard little scenes against the referee: each way of asking, instruction set
// and number of threads, with own faces, tolerances and holes. FACEMAP_QUERIES sets the number of points.

#include <facemap/error.h>
#include <facemap/generators.h>
#include <facemap/viewpoint.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "simd/target.h"
#include "support/cut_out_scenes.h"
#include "support/environment.h"
#include "support/holes.h"
#include "support/oracle.h"
#include "support/queries.h"
#include "support/random.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using test_scenes::TestScene;

constexpr int kLargestFaceCount = 60;

// So many points are sorted before they are asked about.
constexpr std::size_t kManyPoints = 70000;

// How a viewpoint comes to its answers.
enum class Way { Cold, Warm, Singly };
constexpr Way kWays[] = {Way::Cold, Way::Warm, Way::Singly};
constexpr const char* kWayNames[] = {"cold", "warm", "singly"};

std::vector<std::uint8_t> ask(const Viewpoint& viewpoint, const Viewpoint::Targets& targets, Way way) {
  std::vector<std::uint8_t> visible(targets.points.size(), 7);
  const std::span<std::uint8_t> answers(visible);
  if (way == Way::Warm) viewpoint.prepare();
  if (way != Way::Singly) {
    viewpoint.visible(targets, answers);
    return visible;
  }
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const auto face = targets.faces.empty() ? targets.faces : targets.faces.subspan(i, 1);
    viewpoint.visible({targets.points.subspan(i, 1), face, targets.tolerance}, answers.subspan(i, 1));
  }
  return visible;
}

class Session {
 public:
  Session(std::uint64_t seed, bool has_holes) : random_(seed), has_holes_(has_holes) {
    std::printf("seed 0x%llx\n", (unsigned long long)seed);
  }
  ~Session() {
    simd::set_active_target(simd::supported_targets().back());
    std::printf("%llu points, %llu visible, differences: %llu\n", (unsigned long long)points_,
                (unsigned long long)visible_, (unsigned long long)differences_);
  }

  // Returns how many differ.
  std::uint64_t ask_about(std::uint64_t points) {
    while (points_ < points && differences_ < 20) ask_scene();
    return differences_;
  }

 private:
  struct Questions {
    std::vector<Vector> points;
    std::vector<FaceId> faces;
    float tolerance = 0;
  };

  void ask_scene() {
    TestScene test = test_scenes::make_any_scene(random_, kLargestFaceCount);
    if (has_holes_) {
      const Scene scene(test_scenes::with_holes(test, random_));
      const oracle::Holes holes(scene.mesh(), scene.materials(), scene.images());
      compare(test, scene, oracle::Oracle(scene.mesh(), &holes));
    } else {
      const Scene scene(test.mesh);
      compare(test, scene, oracle::Oracle(scene.mesh()));
    }
  }

  void compare(const TestScene& test, const Scene& scene, const oracle::Oracle& oracle) {
    const Vector origin = test_scenes::make_origin(test, random_);
    const oracle::View truth = oracle.from(origin);
    Questions questions = make_questions(test, scene, oracle, truth);
    std::vector<std::uint8_t> expected;
    for (std::size_t i = 0; i < questions.points.size(); ++i) {
      const FaceId own = questions.faces.empty() ? kNoFace : questions.faces[i];
      expected.push_back(truth.is_visible(questions.points[i], own, questions.tolerance));
      visible_ += expected.back();
    }
    points_ += questions.points.size();
    const bool is_repeated = !questions.points.empty() && random_.chance(0.04);
    if (is_repeated) repeat(questions, expected);
    const std::vector<simd::Target> targets = simd::supported_targets();
    simd::set_active_target(targets[static_cast<std::size_t>(random_.below(static_cast<int>(targets.size())))]);
    const Viewpoint viewpoint(scene, origin, {random_.between(1, 3)});
    for (const Way way : kWays) {
      if (is_repeated && way == Way::Singly) continue;
      const auto visible = ask(viewpoint, {questions.points, questions.faces, questions.tolerance}, way);
      for (std::size_t i = 0; i < visible.size(); ++i) {
        if (visible[i] == expected[i]) continue;
        ++differences_;
        const FaceId own = questions.faces.empty() ? kNoFace : questions.faces[i];
        const std::string where = "origin " + test_queries::text(origin) + " point " +
                                  test_queries::text(questions.points[i]) + " on face " + std::to_string(own) +
                                  ", tolerance " + std::to_string(questions.tolerance);
        ADD_FAILURE() << test.name << ", " << kWayNames[static_cast<int>(way)] << ": " << int(visible[i]) << "\n"
                      << where << "\n"
                      << test_queries::write_failure(scene.mesh(), where);
        return;
      }
    }
  }

  Questions make_questions(const TestScene& test, const Scene& scene, const oracle::Oracle& oracle,
                           const oracle::View& truth) {
    Questions questions;
    const int count = random_.chance(0.3) ? random_.below(4) : random_.between(4, 300);
    for (int i = 0; i < count; ++i) questions.points.push_back(make_point(test, oracle, truth));
    if (random_.chance(0.4)) {
      for (int i = 0; i < count; ++i) {
        const int face = random_.between(-1, static_cast<int>(scene.face_count()) - 1);
        questions.faces.push_back(face < 0 ? kNoFace : static_cast<FaceId>(face));
      }
    }
    if (random_.chance(0.2)) {
      questions.tolerance = static_cast<float>(test.radius * std::exp2(random_.between(-30.0, 0.0)));
      if (!std::isfinite(questions.tolerance)) questions.tolerance = 0;
    }
    return questions;
  }

  // The same points again and again.
  static void repeat(Questions& questions, std::vector<std::uint8_t>& expected) {
    for (std::size_t i = 0; expected.size() < kManyPoints; ++i) {
      questions.points.push_back(Vector(questions.points[i]));
      if (!questions.faces.empty()) questions.faces.push_back(FaceId(questions.faces[i]));
      expected.push_back(std::uint8_t(expected[i]));
    }
  }

  Vector make_point(const TestScene& test, const oracle::Oracle& oracle, const oracle::View& truth) {
    const Vector& origin = truth.origin();
    if (random_.chance(0.02)) return origin;
    if (random_.chance(0.05)) return test_scenes::make_origin(test, random_);
    if (random_.chance(0.05)) return far_away();
    while (true) {
      const auto query = test_queries::make_light_query(test, oracle, truth, origin, random_);
      if (!query.is_seen) return query.given;
    }
  }

  // Anything that is finite, denormal numbers among it.
  Vector far_away() {
    Vector point;
    for (int k = 0; k < 3; ++k) {
      point[k] = static_cast<float>(random_.between(-1.0, 1.0) * std::exp2(random_.between(-149.0, 127.0)));
    }
    return point;
  }

  Random random_;
  bool has_holes_;
  std::uint64_t points_ = 0, visible_ = 0, differences_ = 0;
};

std::uint64_t seed() { return number_from_environment("FACEMAP_SEED", 0x7e57000500000001u); }

TEST(ViewpointPoints, EqualTheOracle) {
  EXPECT_EQ(Session(seed(), false).ask_about(number_from_environment("FACEMAP_QUERIES", 150000)), 0u);
}

TEST(ViewpointPoints, BehindHolesEqualTheOracle) {
  EXPECT_EQ(Session(seed() + 1, true).ask_about(number_from_environment("FACEMAP_QUERIES", 40000)), 0u);
}

// A sheet of two faces that leaves everything behind it in the dark, and points there that one of them may not hide.
TEST(ViewpointPoints, OwnFacesHideNothingHoweverFarBehind) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0});
  test_scenes::add_triangle(mesh, {-1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  const Scene scene(mesh);
  const Vector origin(0.1f, 0.2f, 5);
  Random random(seed());
  std::vector<Vector> points;
  std::vector<FaceId> faces;
  for (std::size_t i = 0; i < kManyPoints; ++i) {
    const Vector place(random.in_cube());
    points.push_back({place.x, place.y, random.chance(0.5) ? place.z : 0.001f * place.z});
    faces.push_back(random.between(-1, 1));
  }
  const oracle::Oracle oracle(scene.mesh());
  const oracle::View truth = oracle.from(origin);
  const Viewpoint viewpoint(scene, origin, {1});
  const auto visible = ask(viewpoint, {points, faces}, Way::Warm);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) wrong += visible[i] != truth.is_visible(points[i], faces[i], 0);
  EXPECT_EQ(wrong, 0u);
}

// A scene and points that are too many for the referee: the ways have to agree with each other and with a PointLight.
std::vector<Vector> points_about(const Scene& scene, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector> points(count);
  const Mesh& mesh = scene.mesh();
  for (Vector& point : points) {
    const auto face = static_cast<std::size_t>(random.below(static_cast<int>(mesh.face_count())));
    const double u = random.unit(), v = random.unit() * (1 - u);
    point = Vector((1 - u - v) * DVector(mesh.vertex(face, 0)) + u * DVector(mesh.vertex(face, 1)) +
                   v * DVector(mesh.vertex(face, 2)));
    if (random.chance(0.1)) point = Vector(DVector(scene.centre()) + 3 * scene.bounding_radius() * random.in_cube());
  }
  return points;
}

TEST(ViewpointPoints, WaysAgreeOnManyPoints) {
  for (const char* name : {"bust", "grass"}) {
    const GeneratedScene made = generate_scene(name);
    const Scene scene(made.mesh);
    const std::vector<Vector> points = points_about(scene, 300000, 1);
    const Vector among(DVector(scene.centre()) + 0.3 * scene.bounding_radius());
    for (const Vector& origin : {made.lights[0].position, among}) {
      std::vector<std::uint8_t> expected(points.size());
      PointLight(scene, origin).get_lighten_up(points, expected);
      for (const int threads : {1, 3}) {
        const Viewpoint viewpoint(scene, origin, {threads});
        for (const Way way : {Way::Cold, Way::Warm}) {
          EXPECT_TRUE(ask(viewpoint, {points}, way) == expected) << name << ", " << threads << " threads";
        }
        const std::span<const Vector> some(points.data(), 2000);
        EXPECT_TRUE(std::equal(some.begin(), some.end(), points.begin()));
        const auto singly = ask(viewpoint, {some}, Way::Singly);
        EXPECT_TRUE(std::equal(singly.begin(), singly.end(), expected.begin())) << name << ", singly";
      }
    }
  }
}

TEST(ViewpointPoints, SmallQuestionsMakeWhatIsKept) {
  const GeneratedScene made = generate_scene("bust");
  const Scene scene(made.mesh);
  const std::vector<Vector> points = points_about(scene, 1000, 2);
  for (const Vector& origin : {made.lights[0].position, Vector(scene.centre())}) {
    const Viewpoint viewpoint(scene, origin, {2});
    const std::size_t before = viewpoint.memory_bytes();
    std::vector<std::uint8_t> visible(points.size()), first;
    for (int i = 0; i < 300; ++i) {
      viewpoint.visible({points}, visible);
      if (i == 0) first = visible;
      ASSERT_TRUE(visible == first) << "question " << i;
    }
    EXPECT_GT(viewpoint.memory_bytes(), before + scene.face_count());
  }
}

TEST(ViewpointPoints, SeveralThreadsMayAskTogether) {
  const GeneratedScene made = generate_scene("bust");
  const Scene scene(made.mesh);
  const std::vector<Vector> points = points_about(scene, 20000, 3);
  std::vector<std::uint8_t> expected(points.size());
  Viewpoint(scene, made.lights[0].position).visible({points}, expected);
  const Viewpoint viewpoint(scene, made.lights[0].position, {2});
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      std::vector<std::uint8_t> visible(points.size());
      for (int i = 0; i < 5; ++i) {
        if (t == 3 && i == 2) viewpoint.prepare();
        viewpoint.visible({points}, visible);
        wrong += visible != expected;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(ViewpointPoints, NoPointsHaveNoAnswers) {
  const Scene scene(test_scenes::box(Vector(0), Vector(1)));
  const Viewpoint viewpoint(scene, Vector(3));
  viewpoint.visible({}, {});
  viewpoint.prepare();
  viewpoint.visible({}, {});
}

TEST(ViewpointPoints, RefusesWhatIsNoQuestion) {
  const Scene scene(test_scenes::box(Vector(0), Vector(1)));
  const std::vector<Vector> points(3, Vector(2));
  std::vector<std::uint8_t> visible(3);
  for (const bool is_prepared : {false, true}) {
    const Viewpoint viewpoint(scene, Vector(3), {});
    if (is_prepared) viewpoint.prepare();
    const auto ask = [&](std::vector<Vector> some, std::vector<FaceId> faces, float tolerance) {
      viewpoint.visible({some, faces, tolerance}, visible);
    };
    ask(points, {0, kNoFace, 11}, 0);
    constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNone = std::numeric_limits<float>::quiet_NaN();
    for (const float tolerance : {0.0f, 0.1f}) {
      EXPECT_THROW(ask({Vector(2), Vector(2)}, {}, tolerance), Error);
      EXPECT_THROW(ask(points, {0}, tolerance), Error);
      EXPECT_THROW(ask(points, {0, 12, 0}, tolerance), Error);
      EXPECT_THROW(ask(points, {0, -2, 0}, tolerance), Error);
      EXPECT_THROW(ask({Vector(2), Vector(2), Vector(2, kNone, 2)}, {}, tolerance), Error);
      EXPECT_THROW(ask({Vector(kInfinity), Vector(2), Vector(2)}, {}, tolerance), Error);
    }
    for (const float tolerance : {-1.0f, kInfinity, kNone}) EXPECT_THROW(ask(points, {}, tolerance), Error);
  }
}

TEST(ViewpointPoints, CanBeStopped) {
  const GeneratedScene made = generate_scene("bust");
  const Scene scene(made.mesh);
  const std::vector<Vector> points = points_about(scene, 100000, 4);
  std::vector<std::uint8_t> visible(points.size());
  const Viewpoint viewpoint(scene, made.lights[0].position, {2});
  for (int i = 0; i < 2; ++i) {
    double done = 0;
    viewpoint.visible({points}, visible, [&](double share) {
      EXPECT_GT(share, done);
      done = share;
      return true;
    });
    EXPECT_EQ(done, 1);
    EXPECT_THROW(viewpoint.visible({points}, visible, [](double) { return false; }), Error);
    viewpoint.prepare();
  }
}

}  // namespace
