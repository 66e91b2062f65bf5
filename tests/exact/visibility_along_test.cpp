// Many directions and many points of hard little scenes against the referee of parallel light. FACEMAP_QUERIES sets the
// number of pairs.

#include <facemap/error.h>
#include <facemap/visibility.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "support/environment.h"
#include "support/oracle.h"
#include "support/parallel_oracle.h"
#include "support/parallel_queries.h"
#include "support/queries.h"
#include "support/random.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using oracle::Oracle;
using oracle::ParallelView;
using test_queries::text;
using test_scenes::TestScene;

bool bit(const std::vector<std::uint8_t>& bits, std::size_t points, std::size_t direction, std::size_t point) {
  return (bits[direction * visibility_row_bytes(points) + point / 8] >> (point % 8) & 1) != 0;
}

std::vector<std::uint8_t> ask(const Scene& scene, const std::vector<Vector>& directions,
                              const Viewpoint::Targets& targets, const VisibilityOptions& options = {},
                              const Viewpoint::Progress& progress = {}) {
  std::vector<std::uint8_t> bits(directions.size() * visibility_row_bytes(targets.points.size()), 0xa5);
  visibility_along(scene, directions, targets, bits, options, progress);
  return bits;
}

class Session {
 public:
  explicit Session(std::uint64_t seed) : random_(seed) { std::printf("seed 0x%llx\n", (unsigned long long)seed); }

  void ask_about(std::uint64_t pairs) {
    while (pairs_ < pairs && !testing::Test::HasFailure()) ask_scene();
    std::printf("%llu pairs, %llu visible, %llu by their own face alone\n", (unsigned long long)pairs_,
                (unsigned long long)visible_, (unsigned long long)own_matters_);
    EXPECT_GT(visible_, pairs_ / 20);
    EXPECT_LT(visible_, pairs_ - pairs_ / 20);
    EXPECT_GT(own_matters_, pairs_ / 2000);
  }

 private:
  void ask_scene() {
    static constexpr int kCounts[] = {0, 1, 7, 8, 9, 40, 200};  // the last by maps, where there are few faces
    static constexpr std::size_t kBudgets[] = {0, 1, 100000};
    const TestScene made = test_scenes::make_any_scene(random_, random_.chance(0.1) ? 900 : 60);
    const Scene scene(made.mesh);
    const Oracle oracle(made.mesh);
    if (oracle.kept_faces().empty()) return;
    std::vector<Vector> directions(static_cast<std::size_t>(random_.below(9))), points;
    for (Vector& d : directions) d = test_queries::make_direction(oracle, random_);
    points.resize(static_cast<std::size_t>(kCounts[random_.below(7)]));
    for (Vector& p : points) p = test_queries::make_point(made, oracle, random_);
    std::vector<FaceId> faces;
    if (random_.chance(0.5)) {
      const int count = static_cast<int>(made.mesh.face_count());
      for (std::size_t i = 0; i < points.size(); ++i)
        faces.push_back(random_.chance(0.2) ? kNoFace : random_.below(count));
    }
    // The referee passes over a face or tells of a tolerance, not both.
    const float tolerance = faces.empty() && random_.chance(0.3) ? static_cast<float>(0.1 * made.radius) : 0;
    const auto bits = ask(scene, directions, {points, faces, tolerance},
                          {.threads = 1 + random_.below(3), .memory = kBudgets[random_.below(3)]});
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const ParallelView light(oracle, -directions[i]);
      for (std::size_t j = 0; j < points.size(); ++j) {
        const FaceId own = faces.empty() ? kNoFace : faces[j];
        const oracle::Place place = oracle::place_of(points[j]);
        const bool is_visible =
            tolerance > 0 ? light.is_lit(points[j], {.tolerance = tolerance}) : !light.is_blocked(place, own);
        ++pairs_;
        visible_ += is_visible;
        own_matters_ += own != kNoFace && is_visible && light.is_blocked(place);
        ASSERT_EQ(bit(bits, points.size(), i, j), is_visible)
            << made.name << " along " << text(directions[i]) << " point " << text(points[j]) << " own face " << own
            << " tolerance " << tolerance << "\n"
            << test_queries::write_failure(made.mesh, text(directions[i]) + " " + text(points[j]));
      }
      for (std::size_t j = points.size(); j < 8 * visibility_row_bytes(points.size()); ++j) {
        ASSERT_FALSE(bit(bits, points.size(), i, j)) << "a bit past the last point";
      }
    }
  }

  Random random_;
  std::uint64_t pairs_ = 0, visible_ = 0, own_matters_ = 0;
};

TEST(VisibilityAlong, EqualsTheOracle) {
  Session(number_from_environment("FACEMAP_SEED", 0x5eed0e01))
      .ask_about(number_from_environment("FACEMAP_QUERIES", 60000));
}

std::vector<Vector> some_points(std::size_t count, double reach, Random& random) {
  std::vector<Vector> points(count);
  for (Vector& p : points) p = Vector(reach * random.in_cube());
  return points;
}

TEST(VisibilityAlong, DoesNotDependOnThreadsOrMemory) {
  Random random(0x5eed0e02);
  const TestScene made = test_scenes::make_scene(test_scenes::Kind::Soup, 3000, random);
  const Scene scene(made.mesh);
  const std::vector<Vector> directions = some_points(11, 1, random);
  for (const std::size_t count : {5003u, 20003u}) {  // by passes and by maps
    const std::vector<Vector> points = some_points(count, 1.5, random);
    const auto bits = ask(scene, directions, {points}, {.threads = 1});
    for (const int threads : {2, 3}) {
      for (const std::size_t memory : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20}) {
        EXPECT_EQ(ask(scene, directions, {points}, {.threads = threads, .memory = memory}), bits);
      }
    }
  }
}

// A viewpoint very far away sees what is visible along the direction to it, where nothing is near a tie.
TEST(VisibilityAlong, IsThatOfViewpointsFarAway) {
  Random random(0x5eed0e03);
  const Scene scene(test_scenes::uv_sphere(12, 8, {0, 0, 0}, 1));
  const std::vector<Vector> directions{{1, 2, 3}, {-3, 1, 0.5f}}, points = some_points(300, 2, random);
  const auto bits = ask(scene, directions, {points});
  for (std::size_t i = 0; i < directions.size(); ++i) {
    std::vector<std::uint8_t> visible(points.size());
    Viewpoint(scene, 1e6f * directions[i]).visible({points}, visible);
    for (std::size_t j = 0; j < points.size(); ++j) EXPECT_EQ(bit(bits, points.size(), i, j), visible[j] != 0) << j;
  }
}

TEST(VisibilityAlong, TellsHowFarItIsAndStops) {
  Random random(0x5eed0e04);
  const Scene scene(test_scenes::uv_sphere(12, 8, {0, 0, 0}, 1));
  const std::vector<Vector> directions = some_points(30, 1, random), points = some_points(20, 2, random);
  double last = 0;
  ask(scene, directions, {points}, {.threads = 2}, [&](double done) {
    EXPECT_GT(done, last);
    last = done;
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_THROW(ask(scene, directions, {points}, {.threads = 2}, [](double) { return false; }), Error);
}

TEST(VisibilityAlong, ASceneWithoutSizeHidesNothing) {
  Mesh mesh;
  mesh.positions = {Vector(5), Vector(5), Vector(5)};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<Vector> points(2, Vector(5)), directions{{0, 0, 1}};
  std::vector<std::uint8_t> bits(1);
  visibility_along(Scene(mesh), directions, {points}, bits);
  EXPECT_EQ(bits[0], 3);
}

TEST(VisibilityAlong, RefusesWhatMakesNoSense) {
  const Scene scene(test_scenes::uv_sphere(12, 8, {0, 0, 0}, 1));
  const std::vector<Vector> fine(9, Vector(2, 0, 0)), wild{Vector(0, NAN, 0)}, endless{Vector(HUGE_VALF, 0, 0)},
      zero{Vector(0, 0, 0)};
  const std::vector<FaceId> faces{1, 2}, none(9, static_cast<FaceId>(scene.face_count()));
  for (const auto& directions : {wild, endless, zero}) EXPECT_THROW(ask(scene, directions, {fine}), Error);
  EXPECT_THROW(ask(scene, fine, {wild}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, faces}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, none}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, {}, -1.0f}), Error);
  EXPECT_THROW(ask(scene, fine, {fine}, {.threads = -1}), Error);
  std::vector<std::uint8_t> bits(17);
  EXPECT_THROW(visibility_along(scene, fine, {fine}, bits), Error);
  EXPECT_TRUE(ask(scene, {}, {fine}).empty());
}

}  // namespace
