// A viewpoint's answers about rays (nearest, all hits) and which face hides a point, against the referee, on random
// hard scenes with and without holes, with one thread to three. FACEMAP_QUERIES sets how many, FACEMAP_SEED which.

#include <facemap/camera.h>
#include <facemap/error.h>
#include <facemap/hit_color.h>
#include <facemap/viewpoint.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "support/cut_out_scenes.h"
#include "support/environment.h"
#include "support/oracle.h"
#include "support/queries.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using test_queries::text;
using test_scenes::TestScene;

constexpr int kLargestFaceCount = 150, kLargestFaceCountWithHoles = 40;
constexpr int kDirections = 300, kPoints = 500;  // a viewpoint
constexpr std::uint64_t kMostReports = 5;

// A scene and what is true of it.
struct Case {
  TestScene test;
  Scene scene;
  std::unique_ptr<oracle::Holes> holes;
  oracle::Oracle oracle;

  explicit Case(const TestScene& made) : test(made), scene(made.mesh), oracle(scene.mesh()) {}
  Case(const TestScene& made, Model model)
      : test(made),
        scene(std::move(model)),
        holes(std::make_unique<oracle::Holes>(scene.mesh(), scene.materials(), scene.images())),
        oracle(scene.mesh(), holes.get()) {}
};

// The library's distance is sharp to 2^-30, the referee's to 2^-48; then it is rounded once.
bool is_same_distance(float distance, double truth) {
  if (std::isnan(truth) || truth < std::numeric_limits<float>::min()) return true;  // past the range of normal numbers
  if (truth > std::numeric_limits<float>::max()) return std::isinf(distance);
  const double ulp = double(std::nextafterf(distance, HUGE_VALF)) - double(distance);
  return std::fabs(distance - truth) <= 0.5 * ulp + 0x1p-29 * truth;
}

class Session {
 public:
  explicit Session(std::uint64_t seed) : random_(seed) { std::printf("seed %#" PRIx64 "\n", seed); }
  ~Session() {
    std::printf("%" PRIu64 " directions, %" PRIu64 " hits, %" PRIu64 " points, %" PRIu64 " hidden, %" PRIu64
                " of them behind other than the nearest face, %" PRIu64 " differences\n",
                directions_, hits_, points_, hidden_, behind_own_, differences_);
  }

  void ask(std::uint64_t queries) {
    while (directions_ + points_ < queries && differences_ < kMostReports) ask_scene();
  }

  std::uint64_t differences() const { return differences_; }
  std::uint64_t hidden() const { return hidden_; }
  std::uint64_t behind_own() const { return behind_own_; }

 private:
  void ask_scene() {
    const bool has_holes = random_.chance(0.3);
    const TestScene test =
        test_scenes::make_any_scene(random_, has_holes ? kLargestFaceCountWithHoles : kLargestFaceCount);
    const auto at =
        has_holes ? std::make_unique<Case>(test, test_scenes::with_holes(test, random_)) : std::make_unique<Case>(test);
    const Vector origin = test_scenes::make_origin(test, random_);
    const oracle::View view = at->oracle.from(origin);
    Viewpoint::Options options;
    options.threads = random_.between(1, 3);
    const Viewpoint viewpoint(at->scene, origin, options);
    ask_directions(*at, view, viewpoint);
    ask_points(*at, view, viewpoint);
  }

  void fail(const Case& at, const oracle::View& view, const std::string& what) {
    ++differences_;
    const std::string all = at.test.name + ": from " + text(view.origin()) + ": " + what;
    ADD_FAILURE() << all << "; " << test_queries::write_failure(at.scene.mesh(), all);
  }

  void ask_directions(const Case& at, const oracle::View& view, const Viewpoint& viewpoint) {
    std::vector<Vector> directions;
    for (int i = 0; i < kDirections; ++i) {
      directions.push_back(test_queries::make_camera_query(at.test, view.origin(), random_).direction);
    }
    std::vector<FaceId> faces(directions.size());
    std::vector<float> distances(directions.size());
    viewpoint.nearest(directions, faces, distances);
    const AllHits hits = viewpoint.all_hits(directions);
    ASSERT_EQ(hits.begins.size(), directions.size() + 1);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const Vector& d = directions[i];
      const std::span<const FaceId> met(&hits.faces[0] + hits.begins[i], hits.begins[i + 1] - hits.begins[i]);
      const std::vector<FaceId> truth = view.all_hits(d);
      bool is_right = std::equal(met.begin(), met.end(), truth.begin(), truth.end());
      for (std::size_t k = 0; is_right && k < truth.size(); ++k) {
        is_right = is_same_distance(hits.distances[hits.begins[i] + k], view.distance(truth[k], d));
      }
      if (!is_right) fail(at, view, "all hits along " + text(d));
      const FaceId nearest = view.nearest(d).face;
      const bool is_nearest_right =
          faces[i] == nearest && nearest == (truth.empty() ? kNoFace : truth[0]) &&
          (truth.empty() ? std::isinf(distances[i]) : is_same_distance(distances[i], view.distance(nearest, d)));
      if (!is_nearest_right) fail(at, view, "the nearest along " + text(d) + " is not " + std::to_string(faces[i]));
      hits_ += truth.size();
    }
    directions_ += directions.size();
  }

  FaceId some_own_face(const Case& at, const oracle::View& view, const test_queries::LightQuery& query) {
    if (query.on.face != kNoFace) return query.on.face;
    if (random_.chance(0.2)) return view.first_blocker(query.given, kNoFace);  // the next is first then
    return random_.chance(0.2) ? random_.below(static_cast<int>(at.scene.face_count())) : kNoFace;
  }

  void ask_points(const Case& at, const oracle::View& view, const Viewpoint& viewpoint) {
    std::vector<Vector> points;
    std::vector<FaceId> own;
    while (points.size() < kPoints) {
      const test_queries::LightQuery query =
          test_queries::make_light_query(at.test, at.oracle, view, view.origin(), random_);
      if (query.is_seen) continue;
      points.push_back(query.given);
      own.push_back(some_own_face(at, view, query));
    }
    std::vector<FaceId> blockers(points.size()), without(points.size());
    viewpoint.blocked_by({points, own}, blockers);
    viewpoint.blocked_by({points}, without);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const FaceId truth = view.first_blocker(points[i], own[i]), nearest = view.first_blocker(points[i], kNoFace);
      if (blockers[i] != truth) {
        fail(at, view,
             text(points[i]) + " on face " + std::to_string(own[i]) + " is hidden by " + std::to_string(truth) +
                 ", not " + std::to_string(blockers[i]));
      }
      if (without[i] != nearest) {
        fail(at, view,
             text(points[i]) + " is hidden by " + std::to_string(nearest) + ", not " + std::to_string(without[i]));
      }
      hidden_ += truth != kNoFace;
      behind_own_ += truth != kNoFace && truth != nearest;
      ++points_;
    }
  }

  Random random_;
  std::uint64_t directions_ = 0, hits_ = 0, points_ = 0, hidden_ = 0, behind_own_ = 0, differences_ = 0;
};

TEST(ViewpointRays, EqualTheReferee) {
  Session session(number_from_environment("FACEMAP_SEED", 0x5eed0501));
  session.ask(number_from_environment("FACEMAP_QUERIES", 300'000));
  EXPECT_EQ(session.differences(), 0u);
  EXPECT_GT(session.hidden(), 1000u);
  EXPECT_GT(session.behind_own(), 100u);
}

// A box about the world's origin, its faces turned inwards and outwards alike: every direction meets it.
Scene room(float size) {
  return Scene(test_scenes::box(Vector(-size, -size, -size), Vector(size, 2 * size, 3 * size)));
}

TEST(ViewpointRays, DirectionsOfAnyLengthMeetWhatIsThere) {
  const Scene scene = room(1);
  const Viewpoint viewpoint(scene, Vector(0));
  const oracle::Oracle oracle(scene.mesh());
  const oracle::View view = oracle.from(Vector(0));
  std::vector<Vector> directions;
  for (const float size : {1e-45f, 1e-40f, 1e-38f, 1e-20f, 1.0f, 1e20f, 1e38f, 3.4e38f}) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) directions.push_back(size * Vector(x, y, z));
      }
    }
  }
  // The middle of the map, its antipode, and all about both.
  const DVector sight = scene.centre();
  for (const double sign : {1.0, -1.0}) {
    for (const double off : {0.0, 1e-7, 1e-5, 1e-3}) {
      for (int i = 0; i < 12; ++i) {
        const DVector side(std::cos(i * 0.5236), std::sin(i * 0.5236), 0);
        directions.push_back(Vector(sign * sight + off * side));
      }
    }
  }
  std::vector<FaceId> faces(directions.size());
  std::vector<float> distances(directions.size());
  viewpoint.nearest(directions, faces, distances);
  const AllHits hits = viewpoint.all_hits(directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vector& d = directions[i];
    EXPECT_EQ(faces[i], view.nearest(d).face) << text(d);
    EXPECT_EQ(faces[i] == kNoFace, d == Vector(0)) << text(d);
    if (d == Vector(0)) continue;
    EXPECT_TRUE(is_same_distance(distances[i], view.distance(faces[i], d))) << text(d) << ' ' << distances[i];
    EXPECT_EQ(std::vector<FaceId>(hits.faces.begin() + hits.begins[i], hits.faces.begin() + hits.begins[i + 1]),
              view.all_hits(d))
        << text(d);
  }
}

TEST(ViewpointRays, WhatIsNotFiniteMeetsNothing) {
  const Scene scene = room(1);
  const Viewpoint viewpoint(scene, Vector(0));
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vector> directions{Vector(kNan, 0, 1), Vector(0, kInfinity, 0), Vector(1, 1, -kInfinity), Vector(0),
                                       Vector(-0.0f)};
  std::vector<FaceId> faces(directions.size(), 7);
  std::vector<float> distances(directions.size());
  viewpoint.nearest(directions, faces, distances);
  for (const FaceId face : faces) EXPECT_EQ(face, kNoFace);
  for (const float distance : distances) EXPECT_EQ(distance, kInfinity);
  const AllHits hits = viewpoint.all_hits(directions);
  EXPECT_EQ(hits.begins, std::vector<std::size_t>(directions.size() + 1, 0));
  EXPECT_TRUE(hits.faces.empty() && hits.distances.empty());
}

TEST(ViewpointRays, PointsFarOutAndAtTheOriginAreAnswered) {
  for (const float size : {1e-40f, 1e-30f, 1.0f, 1e30f, 1e38f}) {
    const Scene scene = room(size);
    const oracle::Oracle oracle(scene.mesh());
    const Vector origin(0.25f * size, 0, 0);
    const oracle::View view = oracle.from(origin);
    const Viewpoint viewpoint(scene, origin);
    std::vector<Vector> points{origin, Vector(0), Vector(size, 0, 0), Vector(std::nextafterf(size, HUGE_VALF), 0, 0)};
    for (const float far : {1e-45f, 1e-38f, 1.0f, 1e30f, 3.4e38f}) {
      points.insert(points.end(), {Vector(far, 0, 0), Vector(0, -far, 0), Vector(far, far, -far)});
    }
    std::vector<FaceId> blockers(points.size());
    viewpoint.blocked_by({points}, blockers);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(blockers[i], view.first_blocker(points[i], kNoFace)) << size << ' ' << text(points[i]);
    }
    EXPECT_EQ(blockers[0], kNoFace);
  }
}

TEST(ViewpointRays, QuestionsThatAreNoneAreRefused) {
  const Scene scene = room(1);
  const Viewpoint viewpoint(scene, Vector(0));
  const std::vector<Vector> two{Vector(1), Vector(2)}, odd{Vector(1), Vector(0, NAN, 0)};
  std::vector<FaceId> faces(2), one_face(1), wrong_faces{0, 12};
  std::vector<float> distances(2), one_distance(1);
  EXPECT_THROW(viewpoint.nearest(two, one_face, distances), Error);
  EXPECT_THROW(viewpoint.nearest(two, faces, one_distance), Error);
  EXPECT_THROW(viewpoint.blocked_by({two}, one_face), Error);
  EXPECT_THROW(viewpoint.blocked_by({two, one_face}, faces), Error);
  EXPECT_THROW(viewpoint.blocked_by({two, wrong_faces}, faces), Error);
  EXPECT_THROW(viewpoint.blocked_by({odd}, faces), Error);
  EXPECT_THROW(viewpoint.blocked_by({two, {}, 0.1f}, faces), Error);
  EXPECT_THROW(viewpoint.blocked_by({two, {}, NAN}, faces), Error);
  viewpoint.nearest({}, {}, {});
  viewpoint.blocked_by({}, {});
  EXPECT_EQ(viewpoint.all_hits({}).begins, std::vector<std::size_t>(1, 0));
}

TEST(ViewpointRays, ASceneOfOddFacesIsEmpty) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, Vector(1), Vector(2), Vector(3));
  const Scene scene(mesh);
  const Viewpoint viewpoint(scene, Vector(0));
  const std::vector<Vector> directions{Vector(4)};
  std::vector<FaceId> faces{7};
  std::vector<float> distances(1);
  viewpoint.nearest(directions, faces, distances);
  EXPECT_EQ(faces[0], kNoFace);
  faces = {7};
  viewpoint.blocked_by({directions}, faces);
  EXPECT_EQ(faces[0], kNoFace);
  EXPECT_TRUE(viewpoint.all_hits(directions).faces.empty());
}

TEST(ViewpointRays, PicturesShowHowManyFacesAreMet) {
  Random random(0x5eed0503);
  const TestScene test = test_scenes::make_scene(test_scenes::Kind::Soup, 60, random);
  const Scene scene(test.mesh);
  const Viewpoint viewpoint(scene, Vector(test.centre));
  Viewpoint::ImageOptions options;
  options.width = 40;
  options.height = 30;
  options.sight = Vector(1, 2, -1);
  const Image image = viewpoint.image(options);
  ASSERT_EQ(image.pixels.size(), 1200u);

  Camera::Options same;
  same.field_angle = options.field_angle;
  same.width = options.width;
  same.height = options.height;
  same.keep_all = true;
  const Camera camera(scene, SpaceVector::looking_along(viewpoint.origin(), DVector(options.sight)), same);
  std::vector<int> hits;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Vector d = camera.direction_through({x + 0.5, y + 0.5});
      const Camera::Hit nearest = camera.nearest(d);
      EXPECT_EQ(image.ids[hits.size()], nearest.face);
      EXPECT_EQ(image.depths[hits.size()], nearest.depth);
      hits.push_back(d == Vector(0) ? -1 : camera.count_hits(d));
    }
  }
  const int most = *std::max_element(hits.begin(), hits.end());
  EXPECT_GT(most, 3);
  EXPECT_EQ(std::count(hits.begin(), hits.end(), -1) > 0, true);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(image.pixels[i], hits[i] < 0 ? no_direction_color() : hit_color(hits[i], most));
  }
  EXPECT_EQ(hit_color(0, most), (Color{1, 1, 1}));
  EXPECT_EQ(hit_color(most, most), (Color{0, 0, 0}));
  EXPECT_LT(hit_color(2, most).r, hit_color(1, most).r);
}

TEST(ViewpointRays, PicturesThatAreNoneAreRefused) {
  const Scene scene = room(1);
  const Viewpoint viewpoint(scene, Vector(0));
  const auto refuses = [&](auto change) {
    Viewpoint::ImageOptions options;
    change(options);
    EXPECT_THROW(viewpoint.image(options), Error);
  };
  refuses([](auto& options) { options.width = 0; });
  refuses([](auto& options) { options.height = 40'000; });
  refuses([](auto& options) { options.field_angle = 6.3; });
  refuses([](auto& options) { options.field_angle = NAN; });
  refuses([](auto& options) { options.sight = Vector(0, INFINITY, 0); });
}

// ---- progress, and several callers ------------------------------------------------------------------------

std::vector<Vector> some_directions(std::size_t count) {
  Random random(0x5eed0502);
  std::vector<Vector> directions;
  while (directions.size() < count) directions.push_back(Vector(random.direction()));
  return directions;
}

TEST(ViewpointRays, ProgressRisesToOneAndStops) {
  const Scene scene = room(1);
  const std::vector<Vector> directions = some_directions(20'000);
  std::vector<FaceId> faces(directions.size());
  std::vector<float> distances(directions.size());
  for (const int threads : {1, 2, 3}) {
    Viewpoint::Options options;
    options.threads = threads;
    const Viewpoint viewpoint(scene, Vector(0), options);
    const auto ask_all = [&](const Viewpoint::Progress& progress, int question) {
      if (question == 0) viewpoint.nearest(directions, faces, distances, progress);
      if (question == 1) viewpoint.blocked_by({directions}, faces, progress);
      if (question == 2) viewpoint.all_hits(directions, progress);
    };
    for (int question = 0; question < 3; ++question) {
      double last = 0;
      bool rises = true;
      ask_all([&](double done) { return rises = rises && done > last, last = done, true; }, question);
      EXPECT_TRUE(rises);
      EXPECT_EQ(last, 1);
      int calls = 0;
      EXPECT_THROW(ask_all([&](double) { return ++calls < 3; }, question), Error);
      EXPECT_EQ(calls, 3);
      struct Interrupt {};
      calls = 0;
      EXPECT_THROW(ask_all([&](double) { return ++calls < 3 ? true : throw Interrupt(); }, question), Interrupt);
      EXPECT_EQ(calls, 3);
    }
  }
}

// So many at once are asked in an order of their own; so few as they come.
TEST(ViewpointRays, ManyAtOnceAreAnsweredAsFewAre) {
  Random random(0x5eed0504);
  const TestScene test = test_scenes::make_scene(test_scenes::Kind::Soup, 300, random);
  const Scene scene(test.mesh);
  const std::vector<Vector> directions = some_directions(50'000);
  constexpr std::size_t kFew = 5000;
  for (const bool is_inside : {false, true}) {
    const double away = is_inside ? 0.1 : 3;
    const Vector origin(test.centre.x, test.centre.y, static_cast<float>(test.centre.z + away * test.radius));
    for (const int threads : {1, 2, 3}) {
      Viewpoint::Options options;
      options.threads = threads;
      const Viewpoint viewpoint(scene, origin, options);
      std::vector<Vector> points;
      for (const Vector& d : directions) points.push_back(origin + static_cast<float>(2 * test.radius) * d);
      std::vector<FaceId> faces(directions.size()), blockers(directions.size());
      std::vector<float> distances(directions.size());
      viewpoint.nearest(directions, faces, distances);
      viewpoint.blocked_by({points}, blockers);
      const AllHits hits = viewpoint.all_hits(directions);
      EXPECT_GT(std::count_if(faces.begin(), faces.end(), [](FaceId face) { return face != kNoFace; }), 300);
      for (std::size_t first = 0; first < directions.size(); first += kFew) {
        const std::span<const Vector> few(&directions[first], kFew);
        std::vector<FaceId> few_faces(kFew), few_blockers(kFew);
        std::vector<float> few_distances(kFew);
        viewpoint.nearest(few, few_faces, few_distances);
        viewpoint.blocked_by({{&points[first], kFew}}, few_blockers);
        const AllHits few_hits = viewpoint.all_hits(few);
        EXPECT_TRUE(std::equal(few_faces.begin(), few_faces.end(), &faces[first]));
        EXPECT_TRUE(std::equal(few_distances.begin(), few_distances.end(), &distances[first]));
        EXPECT_TRUE(std::equal(few_blockers.begin(), few_blockers.end(), &blockers[first]));
        const std::size_t begin = hits.begins[first];
        ASSERT_EQ(few_hits.faces.size(), hits.begins[first + kFew] - begin);
        EXPECT_TRUE(std::equal(few_hits.faces.begin(), few_hits.faces.end(), hits.faces.begin() + begin));
        EXPECT_TRUE(std::equal(few_hits.distances.begin(), few_hits.distances.end(), hits.distances.begin() + begin));
        for (std::size_t i = 0; i <= kFew; ++i) ASSERT_EQ(few_hits.begins[i] + begin, hits.begins[first + i]);
      }
    }
  }
}

TEST(ViewpointRays, SeveralThreadsMayAskTogether) {
  const Scene scene = room(1);
  const std::vector<Vector> directions = some_directions(3000);
  const auto answers_of = [&](const Viewpoint& viewpoint) {
    std::vector<FaceId> faces(directions.size()), blockers(directions.size());
    std::vector<float> distances(directions.size());
    viewpoint.nearest(directions, faces, distances);
    viewpoint.blocked_by({directions}, blockers);
    const AllHits hits = viewpoint.all_hits(directions);
    faces.insert(faces.end(), blockers.begin(), blockers.end());
    faces.insert(faces.end(), hits.faces.begin(), hits.faces.end());
    return faces;
  };
  Viewpoint::Options options;
  options.threads = 2;
  const std::vector<FaceId> truth = answers_of(Viewpoint(scene, Vector(0), options));
  const Viewpoint viewpoint(scene, Vector(0), options);
  std::atomic<int> same = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      same += answers_of(viewpoint) == truth;
      EXPECT_GT(viewpoint.memory_bytes(), 0u);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(same, 4);
}

}  // namespace
