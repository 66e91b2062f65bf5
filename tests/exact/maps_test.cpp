// Cameras and lights against the referee: random and contrived scenes, questions on the fence, 0 differences.
// FACEMAP_QUERIES sets how many questions (scripts/verify asks ten million), FACEMAP_SEED which.

#include <facemap/camera.h>
#include <facemap/error.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>

#include "support/environment.h"
#include "support/oracle.h"
#include "support/queries.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using oracle::Oracle;
using test_queries::CameraQuery;
using test_queries::LightQuery;
using test_scenes::TestScene;

struct Tally {
  std::uint64_t queries = 0;
  std::uint64_t aimed = 0;
  std::uint64_t by_exact = 0;  // queries with at least one face left to the exact stage
  std::uint64_t differences = 0;
  Counters tests;

  void add(bool is_aimed, const Counters& counters) {
    ++queries;
    aimed += is_aimed;
    by_exact += counters.by_exact > 0;
    tests += counters;
  }
  Tally& operator+=(const Tally& other) {
    queries += other.queries;
    aimed += other.aimed;
    by_exact += other.by_exact;
    differences += other.differences;
    tests += other.tests;
    return *this;
  }
  void print(const char* name) const {
    std::printf("%-24s %10" PRIu64 " queries, %10" PRIu64 " aimed, %9" PRIu64 " decided by the exact stage, %" PRIu64
                " differences (face tests: %" PRIu64 " float, %" PRIu64 " double, %" PRIu64 " exact)\n",
                name, queries, aimed, by_exact, differences, tests.by_float, tests.by_double, tests.by_exact);
  }
};

constexpr int kLargestSceneFaces = 150;
constexpr int kQueriesPerMap = 1000;
constexpr int kCameras = 2, kLightsPerCamera = 2;
constexpr std::uint64_t kMostReports = 5;  // then it is no use going on

class Session {
 public:
  Session(Builder builder, std::uint64_t seed) : builder_(builder), random_(seed), seed_(seed) {}

  void ask(std::uint64_t queries) {
    const bool stops_early = builder_ == Builder::Cover;
    while (total().queries < queries && !(stops_early && total().differences >= kMostReports)) ask_scene();
  }

  void print() const {
    std::printf("seed %#" PRIx64 "\n", seed_);
    for (const auto& [name, tally] : by_scene_) tally.print(name.c_str());
    cameras_.print("all cameras");
    lights_.print("all lights");
  }

  Tally total() const {
    Tally all = cameras_;
    return all += lights_;
  }
  const Tally& cameras() const { return cameras_; }
  const Tally& lights() const { return lights_; }

 private:
  void ask_scene() {
    const TestScene test = test_scenes::make_any_scene(random_, kLargestSceneFaces);
    const Scene scene(test.mesh);
    const Oracle oracle(scene.mesh());
    for (std::size_t face = 0; face < scene.face_count(); ++face) {
      ASSERT_EQ(scene.is_kept(face), oracle.is_kept(static_cast<FaceId>(face)))
          << face << test_queries::write_failure(scene.mesh(), "kept faces");
    }
    const Tally before = total();
    for (int i = 0; i < kCameras; ++i) {
      const Vector position = test_scenes::make_origin(test, random_);
      const oracle::View view = oracle.from(position);
      ask_camera(test, scene, view);
      for (int j = 0; j < kLightsPerCamera; ++j) ask_light(test, scene, oracle, view);
    }
    Tally own = total();
    own.queries -= before.queries;
    own.aimed -= before.aimed;
    own.by_exact -= before.by_exact;
    own.differences -= before.differences;
    own.tests = {own.tests.by_float - before.tests.by_float, own.tests.by_double - before.tests.by_double,
                 own.tests.by_exact - before.tests.by_exact};
    by_scene_[test.name] += own;
  }

  SpaceVector make_frame(const TestScene& test, const Vector& position) {
    const Vector vertex = test.mesh.positions[random_.below(static_cast<int>(test.mesh.positions.size()))];
    if (random_.chance(0.3) && vertex != position) {  // the axis, or its antipode, at a vertex
      const DVector sight = DVector(vertex) - DVector(position);
      return SpaceVector::looking_along(position, random_.chance(0.5) ? sight : -sight);
    }
    return SpaceVector::looking_along(position, random_.direction());
  }

  void ask_camera(const TestScene& test, const Scene& scene, const oracle::View& view) {
    Camera::Options options;
    options.builder = builder_;
    options.keep_all = random_.chance(0.3);
    const int largest = random_.chance(0.05) ? 200 : 40;
    options.width = random_.between(1, largest);
    options.height = random_.chance(0.5) ? options.width : random_.between(1, largest);
    const bool is_panorama = random_.chance(0.6);
    if (is_panorama) {
      options.field_angle = 2 * M_PI;
    } else {
      options.projection = random_.chance(0.5) ? ProjectionKind::Surface : ProjectionKind::Plane;
      options.field_angle = random_.between(0.2, 3.0);
    }
    const Camera camera(scene, make_frame(test, view.origin()), options);
    for (int i = 0; i < kQueriesPerMap; ++i) {
      const CameraQuery query = test_queries::make_camera_query(test, view.origin(), random_);
      Counters counters;
      const Camera::Hit hit = camera.nearest(query.direction, &counters);
      cameras_.add(query.is_aimed, counters);
      const bool is_zero = query.direction == Vector(0);
      const bool is_outside = is_zero || !camera.texel_of(DVector(query.direction));
      EXPECT_TRUE(!is_panorama || is_zero || !is_outside) << test_queries::text(query.direction);
      const oracle::Hit truth = is_outside ? oracle::Hit() : view.nearest(query.direction);
      const int hits = camera.count_hits(query.direction);
      const int true_hits = is_outside ? 0 : view.count_hits(query.direction);
      const bool is_same = oracle::Hit{hit.face, hit.strictly_inside, hit.tied, hit.side} == truth &&
                           (options.keep_all ? hits == true_hits : hits <= true_hits) &&
                           is_depth_of(hit, view, query.direction);
      if (is_same) continue;
      ++cameras_.differences;
      if (builder_ == Builder::Fill) {  // may miss a face, never make one up
        EXPECT_TRUE(hit.face == kNoFace || view.meets(hit.face, query.direction));
        continue;
      }
      ADD_FAILURE() << test.name << ": camera at " << test_queries::text(view.origin()) << " along "
                    << test_queries::text(query.direction) << " on " << options.width << " x " << options.height
                    << ", field " << options.field_angle << ": sees " << hit.face << " (" << hit.strictly_inside
                    << hit.tied << hit.side << ", " << hits << " hits), the oracle " << truth.face << " ("
                    << truth.strictly_inside << truth.tied << truth.side << ", " << true_hits << " hits), depth "
                    << hit.depth << " of " << (hit ? view.distance(hit.face, query.direction) : 0) << "; "
                    << test_queries::write_failure(scene.mesh(), "camera " + test_queries::text(view.origin()) +
                                                                     " along " + test_queries::text(query.direction));
    }
  }

  // The distance rounded to float32, from a double that may be off by 2^-30 relative and a little.
  static bool is_depth_of(const Camera::Hit& hit, const oracle::View& view, const Vector& direction) {
    if (!hit) return hit.depth == std::numeric_limits<float>::infinity();
    const double truth = view.distance(hit.face, direction);
    if (std::isnan(truth) || truth < std::numeric_limits<float>::min()) return true;
    if (truth > std::numeric_limits<float>::max()) return std::isinf(hit.depth);
    const double ulp = double(std::nextafterf(hit.depth, HUGE_VALF)) - double(hit.depth);
    return std::fabs(hit.depth - truth) <= 0.5 * ulp + 0x1p-29 * truth;
  }

  void ask_light(const TestScene& test, const Scene& scene, const Oracle& oracle, const oracle::View& camera) {
    PointLight::Options options;
    options.builder = builder_;
    options.keep_all = random_.chance(0.2);
    if (random_.chance(0.7)) options.texels = random_.between(1, 48);
    if (random_.chance(0.2)) options.field_angle = 2 * M_PI;
    const Vector position = test_scenes::make_origin(test, random_);
    const oracle::View view = oracle.from(position);
    const PointLight light(scene, position, options);
    for (int i = 0; i < kQueriesPerMap / kLightsPerCamera; ++i) {
      const LightQuery query = test_queries::make_light_query(test, oracle, camera, position, random_);
      Counters counters;
      const bool is_lit = query.is_seen ? light.get_lighten_up(query.seen, &counters)
                                        : light.get_lighten_up(query.given, query.on, &counters);
      lights_.add(query.is_aimed, counters);
      const bool truth = query.is_seen ? view.is_lit(query.seen) : view.is_lit(query.given, query.on);
      bool is_same = is_lit == truth;
      if (query.is_seen) is_same = is_same && light.is_blocked(query.seen) == view.is_blocked(query.seen);
      if (is_same) continue;
      ++lights_.differences;
      if (builder_ == Builder::Fill) {  // may miss a blocker, never make one up
        EXPECT_TRUE(is_lit || !truth);
        continue;
      }
      ADD_FAILURE() << test.name << ": light at " << test_queries::text(position) << " with " << light.width()
                    << " texels over " << light.projection().field_angle() << ": " << test_queries::text(query)
                    << " is " << (is_lit ? "lit" : "dark") << ", the oracle says otherwise; "
                    << test_queries::write_failure(
                           scene.mesh(), "light " + test_queries::text(position) + ": " + test_queries::text(query));
    }
  }

  Builder builder_;
  Random random_;
  std::uint64_t seed_;
  Tally cameras_, lights_;
  std::map<std::string, Tally> by_scene_;
};

TEST(Maps, CoverEqualsTheOracle) {
  const std::uint64_t queries = number_from_environment("FACEMAP_QUERIES", 300'000);
  Session session(Builder::Cover, number_from_environment("FACEMAP_SEED", 0x5eed0002));
  session.ask(queries);
  session.print();
  const Tally total = session.total();
  total.print("all");
  EXPECT_EQ(total.differences, 0u);
  EXPECT_GE(2 * total.aimed, total.queries);
  EXPECT_GE(50 * total.by_exact, total.queries);  // 200,000 in ten million
}

TEST(Maps, FillMissesFacesAtEdgesButMakesNoneUp) {
  const std::uint64_t queries = number_from_environment("FACEMAP_QUERIES", 300'000) / 10;
  Session session(Builder::Fill, number_from_environment("FACEMAP_SEED", 0x5eed0003));
  session.ask(queries);
  session.print();
  EXPECT_GE(session.total().queries, queries);
}

}  // namespace
