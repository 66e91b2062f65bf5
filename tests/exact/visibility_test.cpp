// Many origins and many points of hard little scenes against the referee, for each instruction set, number of threads
// and memory budget. FACEMAP_QUERIES sets the number of pairs.

#include <facemap/error.h>
#include <facemap/visibility.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simd/target.h"
#include "support/environment.h"
#include "support/oracle.h"
#include "support/queries.h"
#include "support/random.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using test_scenes::TestScene;

bool is_visible(const std::vector<std::uint8_t>& bits, std::size_t points, std::size_t origin, std::size_t point) {
  return (bits[origin * visibility_row_bytes(points) + point / 8] >> (point % 8) & 1) != 0;
}

// The mesh without a face and those with the same three positions, their numbers kept.
Mesh without(const Mesh& mesh, FaceId face) {
  const auto positions = [&](std::size_t f) {
    std::array<std::array<float, 3>, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vector& p = mesh.vertex(f, k);
      corners[static_cast<std::size_t>(k)] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  Mesh rest = mesh;
  const auto gone = positions(static_cast<std::size_t>(face));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (positions(f) == gone) rest.triangles[f] = {rest.triangles[f][0], rest.triangles[f][0], rest.triangles[f][0]};
  }
  return rest;
}

// What the referee says, the point's own face left out.
class Truth {
 public:
  explicit Truth(const Mesh& mesh) : mesh_(mesh), all_(mesh) {}

  bool is_visible(const Vector& origin, const Vector& point, FaceId own) {
    if (own == kNoFace || !all_.is_kept(own)) return all_.from(origin).is_lit(point, {});
    auto& rest = rest_[own];
    if (!rest) rest.emplace(without(mesh_, own));
    return rest->oracle.from(origin).is_lit(point, {});
  }

 private:
  struct Rest {
    explicit Rest(Mesh&& without_own) : mesh(std::move(without_own)), oracle(mesh) {}
    Mesh mesh;
    oracle::Oracle oracle;
  };

  const Mesh& mesh_;
  oracle::Oracle all_;
  std::map<FaceId, std::optional<Rest>> rest_;
};

struct Question {
  std::vector<Vector> origins, points;
  std::vector<FaceId> faces;

  Viewpoint::Targets targets() const { return {points, faces}; }
};

class Session {
 public:
  explicit Session(std::uint64_t seed) : random_(seed) { std::printf("seed 0x%llx\n", (unsigned long long)seed); }
  ~Session() { simd::set_active_target(simd::supported_targets().back()); }

  void ask(std::uint64_t pairs) {
    for (std::uint64_t scenes = 0; pairs_ < pairs; ++scenes) {
      const TestScene scene = test_scenes::make_any_scene(random_, random_.chance(0.1) ? 900 : 60);
      ask_about(scene);
      if (::testing::Test::HasFailure()) return;
    }
    std::printf("%llu pairs, %llu visible\n", (unsigned long long)pairs_, (unsigned long long)visible_);
    EXPECT_GT(visible_, pairs_ / 20);
    EXPECT_LT(visible_, pairs_ - pairs_ / 20);
  }

 private:
  // Points as lights are asked about them: at vertices, on edges and planes, near and far; some equal to an origin.
  Question make_question(const TestScene& scene) {
    static constexpr int kCounts[] = {0, 1, 7, 8, 9, 15, 16, 17, 40};
    Question question;
    const int origins = random_.below(12), points = kCounts[random_.below(9)];
    for (int i = 0; i < origins; ++i) question.origins.push_back(test_scenes::make_origin(scene, random_));
    const oracle::Oracle oracle(scene.mesh);
    const Vector from = test_scenes::make_origin(scene, random_);
    const oracle::View view = oracle.from(from);
    while (static_cast<int>(question.points.size()) < points) {
      if (origins > 0 && random_.chance(0.05)) {
        question.points.push_back(question.origins[static_cast<std::size_t>(random_.below(origins))]);
      } else if (random_.chance(0.3)) {
        question.points.push_back(test_scenes::make_origin(scene, random_));
      } else {
        const auto query = test_queries::make_light_query(scene, oracle, view, from, random_);
        if (!query.is_seen) question.points.push_back(query.given);
      }
    }
    if (random_.chance(0.4)) {
      const int faces = static_cast<int>(scene.mesh.face_count());
      for (int i = 0; i < points; ++i) question.faces.push_back(random_.chance(0.3) ? kNoFace : random_.below(faces));
    }
    return question;
  }

  VisibilityOptions make_options() {
    static constexpr std::size_t kBudgets[] = {0, 1, 100000, 100000000};
    VisibilityOptions options;
    options.threads = 1 + random_.below(3);
    options.memory = kBudgets[random_.below(4)];
    return options;
  }

  void ask_about(const TestScene& made) {
    const Scene scene(made.mesh);
    const auto targets = simd::supported_targets();
    const Question question = make_question(made);
    const std::size_t points = question.points.size();
    simd::set_active_target(targets[static_cast<std::size_t>(random_.below(static_cast<int>(targets.size())))]);
    std::vector<std::uint8_t> bits(question.origins.size() * visibility_row_bytes(points), 0xa5);
    visibility(scene, question.origins, question.targets(), bits, make_options());

    Truth truth(made.mesh);
    for (std::size_t i = 0; i < question.origins.size(); ++i) {
      for (std::size_t j = 0; j < points; ++j) {
        const FaceId own = question.faces.empty() ? kNoFace : question.faces[j];
        const bool answer = is_visible(bits, points, i, j);
        ++pairs_;
        visible_ += answer;
        ASSERT_EQ(answer, truth.is_visible(question.origins[i], question.points[j], own))
            << made.name << " origin " << test_queries::text(question.origins[i]) << " point "
            << test_queries::text(question.points[j]) << " own face " << own << "\n"
            << test_queries::write_failure(
                   made.mesh, test_queries::text(question.origins[i]) + " " + test_queries::text(question.points[j]));
      }
      for (std::size_t j = points; j < 8 * visibility_row_bytes(points); ++j) {
        ASSERT_FALSE(is_visible(bits, points, i, j)) << "a bit past the last point";
      }
    }
  }

  Random random_;
  std::uint64_t pairs_ = 0, visible_ = 0;
};

TEST(Visibility, EqualsTheOracle) {
  Session(number_from_environment("FACEMAP_SEED", 0x5eed0d15)).ask(number_from_environment("FACEMAP_QUERIES", 60000));
}

Scene ball() { return Scene(test_scenes::uv_sphere(12, 8, {0, 0, 0}, 1)); }

std::vector<Vector> points_about(int count, double reach, Random& random) {
  std::vector<Vector> points;
  for (int i = 0; i < count; ++i) points.push_back(Vector(reach * random.in_cube()));
  return points;
}

std::vector<std::uint8_t> ask(const Scene& scene, const std::vector<Vector>& origins, const Viewpoint::Targets& targets,
                              const VisibilityOptions& options = {}, const Viewpoint::Progress& progress = {}) {
  std::vector<std::uint8_t> bits(origins.size() * visibility_row_bytes(targets.points.size()), 0xa5);
  visibility(scene, origins, targets, bits, options, progress);
  return bits;
}

TEST(Visibility, DoesNotDependOnThreadsOrMemory) {
  Random random(0x5eed0d16);
  const TestScene made = test_scenes::make_scene(test_scenes::Kind::Soup, 3000, random);
  const Scene scene(made.mesh);
  const std::vector<Vector> origins = points_about(90, 1.5, random), points = points_about(5003, 1.5, random);
  const Viewpoint::Targets targets{points};
  const auto bits = ask(scene, origins, targets, {.threads = 1});
  for (const int threads : {2, 3}) {
    for (const std::size_t memory : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20}) {
      EXPECT_EQ(ask(scene, origins, targets, {.threads = threads, .memory = memory}), bits);
    }
  }
}

TEST(Visibility, IsThatOfViewpoints) {
  Random random(0x5eed0d17);
  const TestScene made = test_scenes::make_scene(test_scenes::Kind::Soup, 300, random);
  const Scene scene(made.mesh);
  const std::vector<Vector> origins = points_about(20, 1.5, random), points = points_about(301, 1.5, random);
  for (const float tolerance : {0.0f, 0.05f}) {
    const Viewpoint::Targets targets{points, {}, tolerance};
    const auto bits = ask(scene, origins, targets);
    std::vector<std::uint8_t> visible(points.size());
    for (std::size_t i = 0; i < origins.size(); ++i) {
      Viewpoint(scene, origins[i]).visible(targets, visible);
      for (std::size_t j = 0; j < points.size(); ++j) {
        ASSERT_EQ(is_visible(bits, points.size(), i, j), visible[j] != 0) << tolerance << " " << i << " " << j;
      }
    }
  }
}

// A determinant of some 2^-149 has lost what the smallest distances make large.
TEST(Visibility, FacesTooSmallForFloat32HideWhatIsBehindThem) {
  const float a = 0x1.ae1cb8p-79f, s = 0x1.1a1674p-36f;
  Mesh mesh;
  mesh.positions = {{a, a, a}, {s, -s, 0}, {0, s, -s}, {0.5f, 0.5f, -1}, {1.5f, 0.5f, -1}, {0.5f, 1.5f, -1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const Vector origin(0), point(0x1.000002p-60f, -0x1p-61f, -0x1.fffd68p-62f);
  ASSERT_FALSE(Truth(mesh).is_visible(origin, point, kNoFace));
  std::vector<std::uint8_t> bits(1, 0xff);
  visibility(Scene(mesh), {&origin, 1}, {{&point, 1}}, bits);
  EXPECT_EQ(bits[0], 0);
}

TEST(Visibility, TellsHowFarItIsAndStops) {
  Random random(0x5eed0d18);
  const Scene scene = ball();
  const std::vector<Vector> origins = points_about(30, 2, random), points = points_about(20, 2, random);
  double last = 0;
  int calls = 0;
  ask(scene, origins, {points}, {.threads = 2}, [&](double done) {
    EXPECT_GT(done, last);
    last = done;
    ++calls;
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_GT(calls, 1);
  EXPECT_THROW(ask(scene, origins, {points}, {.threads = 2}, [](double) { return false; }), Error);
}

TEST(Visibility, RefusesWhatMakesNoSense) {
  const Scene scene = ball();
  const std::vector<Vector> fine(9, Vector(2, 0, 0)), wild{Vector(0, NAN, 0)}, endless{Vector(HUGE_VALF, 0, 0)};
  const std::vector<FaceId> faces{1, 2}, none(9, static_cast<FaceId>(scene.face_count())), below(9, -2);
  EXPECT_THROW(ask(scene, wild, {fine}), Error);
  EXPECT_THROW(ask(scene, fine, {wild}), Error);
  EXPECT_THROW(ask(scene, endless, {fine}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, faces}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, none}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, below}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, {}, -1.0f}), Error);
  EXPECT_THROW(ask(scene, fine, {fine, {}, NAN}), Error);
  EXPECT_THROW(ask(scene, fine, {fine}, {.threads = -1}), Error);
  std::vector<std::uint8_t> bits(17);
  EXPECT_THROW(visibility(scene, fine, {fine}, bits), Error);
}

}  // namespace
