// Maps along a direction against the referee that asks every face: what parallel rays see, and what parallel light
// reaches.

#include <facemap/parallel_light.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "support/environment.h"
#include "support/parallel_oracle.h"
#include "support/parallel_queries.h"
#include "support/queries.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using oracle::Oracle;
using oracle::ParallelView;
using test_queries::text;
using test_scenes::TestScene;

oracle::Hit as_oracle(const Camera::Hit& hit) { return {hit.face, hit.strictly_inside, hit.tied, hit.side}; }

struct Tally {
  std::uint64_t queries = 0, hits = 0, tied = 0, blocked = 0;
  Counters counters;
};

class Session {
 public:
  explicit Session(std::uint64_t seed) : random_(seed) { std::printf("seed 0x%llx\n", (unsigned long long)seed); }

  const Tally& ask(std::uint64_t queries) {
    while (tally_.queries < queries && !testing::Test::HasFatalFailure()) ask_scene();
    std::printf("%llu queries, %llu hits, %llu tied, %llu blocked; by float %llu, double %llu, exactly %llu\n",
                (unsigned long long)tally_.queries, (unsigned long long)tally_.hits, (unsigned long long)tally_.tied,
                (unsigned long long)tally_.blocked, (unsigned long long)tally_.counters.by_float,
                (unsigned long long)tally_.counters.by_double, (unsigned long long)tally_.counters.by_exact);
    return tally_;
  }

 private:
  ParallelMap::Options make_options() {
    ParallelMap::Options options;
    if (random_.chance(0.5)) options.texels = random_.between(1, 100);
    options.keep_all = random_.chance(0.3);
    return options;
  }

  void ask_scene() {
    const TestScene test = test_scenes::make_any_scene(random_, 60);
    const Scene scene(test.mesh);
    const Oracle oracle(scene.mesh());
    if (oracle.kept_faces().empty()) return;
    const Vector along = test_queries::make_direction(oracle, random_),
                 d = test_queries::make_direction(oracle, random_);
    const ParallelView camera_truth(oracle, along), light_truth(oracle, d);
    const ParallelMap camera(scene, along, make_options());
    const ParallelLight light(scene, d, make_options());
    for (int i = 0; i < 60; ++i, ++tally_.queries) {
      ask_ray(test, oracle, camera, camera_truth, light, light_truth);
      ask_point(test, oracle, light, light_truth);
      if (testing::Test::HasFatalFailure()) return;
    }
  }

  std::string where(const TestScene& test, const ParallelMap& map, const Vector& place) {
    const std::string text_of = " along " + text(map.direction()) + " at " + text(place) + " map " +
                                std::to_string(map.width()) + "x" + std::to_string(map.height());
    return test.name + text_of + "; " + test_queries::write_failure(test.mesh, text_of);
  }

  // Now and then from far off.
  Vector make_ray_origin(const TestScene& test, const Oracle& oracle, const Vector& d) {
    const Vector O = test_queries::make_ray_origin(test, oracle, d, random_);
    if (!random_.chance(0.1)) return O;
    const double away = test.radius * std::exp2(random_.between(2.0, 40.0)) / glm::length(DVector(d));
    const Vector far(DVector(O) - away * DVector(d));
    return std::isfinite(far.x + far.y + far.z) ? far : O;
  }

  void ask_ray(const TestScene& test, const Oracle& oracle, const ParallelMap& camera, const ParallelView& camera_truth,
               const ParallelLight& light, const ParallelView& light_truth) {
    const Vector O = make_ray_origin(test, oracle, camera.direction());
    const Camera::Hit hit = camera.nearest(O, &tally_.counters);
    ASSERT_EQ(as_oracle(hit), camera_truth.nearest(O)) << where(test, camera, O);
    if (!hit) return;
    ++tally_.hits;
    tally_.tied += hit.tied;
    const SurfacePoint point = camera.surface_point(O, hit);
    const bool is_blocked = light_truth.is_blocked(oracle::place_of(point));
    tally_.blocked += is_blocked;
    ASSERT_EQ(light.is_blocked(point, &tally_.counters), is_blocked) << where(test, light, O);
    ASSERT_EQ(light.get_lighten_up(point), light_truth.is_lit(point)) << where(test, light, O);
  }

  void ask_point(const TestScene& test, const Oracle& oracle, const ParallelLight& light, const ParallelView& truth) {
    Vector P = test_queries::make_point(test, oracle, random_);
    if (random_.chance(0.1)) {
      const Vector moved(DVector(test.centre) +
                         test.radius * std::exp2(random_.between(-4.0, 30.0)) * random_.in_cube());
      if (std::isfinite(moved.x + moved.y + moved.z)) P = moved;
    }
    ParallelLight::On on;
    if (random_.chance(0.3))
      on.face =
          oracle.kept_faces()[static_cast<std::size_t>(random_.below(static_cast<int>(oracle.kept_faces().size())))];
    if (on.face == kNoFace && random_.chance(0.3)) on.tolerance = static_cast<float>(0.1 * test.radius);
    const bool is_lit = truth.is_lit(P, on);
    tally_.blocked += !is_lit;
    ASSERT_EQ(light.get_lighten_up(P, on, &tally_.counters), is_lit)
        << where(test, light, P) << " on " << on.face << " tolerance " << on.tolerance;
    std::uint8_t together = 2;
    if (on.face != kNoFace || on.tolerance > 0) return;
    light.get_lighten_up(std::span(&P, 1), std::span(&together, 1));
    ASSERT_EQ(together, is_lit);
  }

  Random random_;
  Tally tally_;
};

TEST(ParallelMaps, EqualTheOracle) {
  Session session(number_from_environment("FACEMAP_SEED", 0x5eed0420));
  const std::uint64_t queries = number_from_environment("FACEMAP_QUERIES", 100'000);
  const Tally& tally = session.ask(queries);
  EXPECT_GT(tally.hits, queries / 4);
  EXPECT_GT(tally.tied, queries / 100);
  EXPECT_GT(tally.blocked, queries / 100);
  EXPECT_GT(tally.counters.by_exact, 0u);
}

}  // namespace
