// The predicates for parallel light and parallel rays on whole scenes: asked of every face they give the referee's
// answers, and of a closed part the exits alone give the answer of all its faces.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "math/parallel_signs.h"
#include "support/parallel_oracle.h"
#include "support/parallel_queries.h"
#include "support/queries.h"
#include "support/scenes.h"

namespace {

using facemap::Covering;
using facemap::DVector;
using facemap::FaceId;
using facemap::GivenPoint;
using facemap::kNoFace;
using facemap::Mesh;
using facemap::SurfacePoint;
using facemap::Triangle;
using facemap::TruePoint;
using facemap::Vector;
using oracle::Hit;
using oracle::Oracle;
using oracle::ParallelView;
using test_queries::make_direction;
using test_queries::make_point;
using test_queries::make_ray_origin;
using test_queries::text;
using test_scenes::TestScene;

int query_count() {
  const char* queries = std::getenv("FACEMAP_QUERIES");
  return queries != nullptr ? std::atoi(queries) : 200000;
}

// Every face of a mesh, asked one after the other.
class AllFaces {
 public:
  AllFaces(const Oracle& oracle, const Vector& d) : d_(d) {
    for (const FaceId id : oracle.kept_faces()) {
      const Mesh& mesh = oracle.mesh();
      const Triangle f{mesh.vertex(id, 0), mesh.vertex(id, 1), mesh.vertex(id, 2)};
      faces_.push_back({id, facemap::side_along(f, d), f});
    }
  }

  int side(FaceId id) const {
    for (const Face& f : faces_) {
      if (f.id == id) return f.s;
    }
    return 0;
  }

  const Triangle& triangle(FaceId id) const {
    for (const Face& f : faces_) {
      if (f.id == id) return f.corners;
    }
    return faces_.front().corners;
  }

  Hit nearest(const Vector& O) const {
    Hit best;
    const Face* nearest = nullptr;
    for (const Face& f : faces_) {
      const Covering covering = facemap::covers_along(f.corners, f.s, O, d_);
      if (!covering.hit) continue;
      const int order =
          nearest == nullptr ? -1 : facemap::compare_depth(f.corners, f.s, nearest->corners, nearest->s, O, d_);
      const bool is_tied = order == 0 || (order > 0 && best.tied);
      if (order < 0 || (order == 0 && f.s < 0 && best.side > 0)) {
        nearest = &f;
        best = {f.id, covering.strictly_inside, false, f.s};
      }
      best.tied = is_tied;
    }
    return best;
  }

  // Of the faces that `asks(s)` chooses.
  template <class Point, class Choice>
  bool is_blocked(const Point& point, const Choice& asks, FaceId skipped = kNoFace) const {
    for (const Face& f : faces_) {
      if (f.id != skipped && asks(f.s) && facemap::blocks_along(f.corners, f.s, d_, point)) return true;
    }
    return false;
  }

  template <class Point>
  bool is_blocked(const Point& point, FaceId skipped = kNoFace) const {
    return is_blocked(
        point, [](int) { return true; }, skipped);
  }

 private:
  struct Face {
    FaceId id;
    int s;
    Triangle corners;
  };
  Vector d_;
  std::vector<Face> faces_;
};

TruePoint true_point(const SurfacePoint& point) { return {point.origin, point.direction, point.vertices, point.side}; }

TEST(Parallel, EveryFaceAskedEqualsTheOracle) {
  constexpr std::uint64_t kSeed = 0x5eed0410;
  Random random(kSeed);
  int queries = 0, hits = 0, tied = 0, blocked = 0;
  while (queries < query_count()) {
    const TestScene scene = test_scenes::make_any_scene(random, 24);
    const Oracle oracle(scene.mesh);
    if (oracle.kept_faces().empty()) continue;
    const Vector along = make_direction(oracle, random), d = make_direction(oracle, random);
    const ParallelView camera(oracle, along), light(oracle, d);
    const AllFaces seen(oracle, along), lit(oracle, d);
    for (int i = 0; i < 60; ++i, ++queries) {
      const Vector O = make_ray_origin(scene, oracle, along, random);
      const auto describe = [&] {
        return scene.name + ", rays " + text(along) + ", light " + text(d) + ", from " + text(O) + "; " +
               test_queries::write_failure(scene.mesh, text(along) + text(d) + text(O));
      };
      const Hit hit = seen.nearest(O);
      ASSERT_EQ(hit, camera.nearest(O)) << describe();
      if (hit.face != kNoFace) {
        const SurfacePoint point{O, along, seen.triangle(hit.face), hit.face, hit.side};
        const bool is_dark = lit.is_blocked(true_point(point));
        ASSERT_EQ(facemap::is_facing_along(point.vertices, hit.side, d) && !is_dark, light.is_lit(point)) << describe();
        ASSERT_EQ(is_dark, light.is_blocked(oracle::place_of(point))) << describe();
        ++hits;
        tied += hit.tied;
        blocked += is_dark;
      }
      const Vector P = make_point(scene, oracle, random);
      const FaceId on = random.chance(0.3) ? oracle.kept_faces().front() : kNoFace;
      const float tolerance = on == kNoFace && random.chance(0.3) ? static_cast<float>(0.1 * scene.radius) : 0;
      GivenPoint given{P, on == kNoFace ? nullptr : &lit.triangle(on), tolerance};
      ASSERT_EQ(!lit.is_blocked(given, on), light.is_lit(P, {.face = on, .tolerance = tolerance}))
          << describe() << ", at " << text(P);
    }
  }
  std::printf("%d queries, %d hits, %d tied, %d blocked\n", queries, hits, tied, blocked);
  EXPECT_GT(hits, queries / 4);
  EXPECT_GT(tied, queries / 100);
  EXPECT_GT(blocked, queries / 100);
}

// ---- closed parts -----------------------------------------------------------------------------------------

struct Solid {
  Mesh mesh;
  float reach;  // all of it is within this of the origin
};

// A box pushed through itself is inside out in places; boxes that touch and a ball that is pierced are unions of
// cycles.
std::vector<Solid> solids() {
  using test_scenes::box;
  using test_scenes::joined;
  Mesh folded = box({-2, -2, 0}, {2, 2, 2});
  for (const std::size_t top : {4u, 5u, 6u, 7u}) folded.positions[top].z -= 3;
  return {{box({-1, -1, -1}, {1, 1, 1}), 2},
          {joined(box({-4, -4, -1}, {4, 4, 0}), box({-1, -1, 0}, {1, 1, 2})), 6},
          {joined(box({-3, -3, -1}, {-1, 3, 4}), box({-1, -1, -1}, {3, 3, 0})), 6},
          {folded, 4},
          {joined(test_scenes::geodesic_sphere(2, {0, 0, 0}, 2), box({-0.5f, -0.5f, -4}, {0.5f, 0.5f, 4})), 5}};
}

struct Count {
  int asked = 0, blocked = 0, moved = 0;
};

bool is_exit(int s) { return s > 0; }

// What a parallel camera wholly before the solid sees, and points lifted off it, in light along d.
void compare_exits(const Solid& solid, Random& random, Count& count) {
  const Oracle oracle(solid.mesh);
  const auto whole = [&] { return Vector(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)); };
  const bool is_whole = random.chance(0.5);
  const Vector along = is_whole ? whole() : Vector(random.direction()),
               d = is_whole ? whole() : Vector(random.direction());
  if (along == Vector(0) || d == Vector(0)) return;
  const AllFaces camera(oracle, along), light(oracle, d);
  for (int i = 0; i < 200; ++i) {
    const Vector aim(0.8 * solid.reach * random.in_cube());
    const Vector at = is_whole && random.chance(0.5) ? glm::floor(aim) : aim;
    const Vector O = at - 16.0f * along / (is_whole ? 1.0f : glm::length(along));
    const Hit hit = camera.nearest(O);
    if (hit.face == kNoFace) continue;
    const TruePoint point{O, along, camera.triangle(hit.face), hit.side};
    if (!facemap::is_facing_along(point.face, hit.side, d)) continue;
    if (hit.strictly_inside && !hit.tied) {
      const bool by_all = light.is_blocked(point);
      ASSERT_EQ(light.is_blocked(point, is_exit), by_all) << text(along) << text(d) << text(O);
      ++count.asked;
      count.blocked += by_all;
    }
    // Lifted by a random step, and seen by the camera: no face blocks it there.
    const DVector K(O), c(along),
        n = glm::cross(DVector(point.face[1] - point.face[0]), DVector(point.face[2] - point.face[0]));
    const double t = glm::dot(n, DVector(point.face[0]) - K) / glm::dot(n, c);
    const GivenPoint Q{Vector(K + t * c + 0.05 * random.in_cube())};
    if (camera.is_blocked(Q)) continue;
    ASSERT_EQ(light.is_blocked(Q, is_exit), light.is_blocked(Q)) << text(along) << text(d) << text(Q.P);
    ++count.moved;
  }
}

TEST(Parallel, ExitsOfClosedPartsAnswerForAllTheirFaces) {
  Random random(0x5eed0411);
  Count count;
  for (const Solid& solid : solids()) {
    for (int i = 0; i < 300; ++i) compare_exits(solid, random, count);
    if (HasFatalFailure()) return;
  }
  std::printf("%d seen points, %d blocked, %d moved ones\n", count.asked, count.blocked, count.moved);
  EXPECT_GT(count.asked, 10000);
  EXPECT_GT(count.blocked, 1000);
  EXPECT_GT(count.moved, 5000);
}

// Why the theorem asks for a camera off the part with winding number 0: what it sees from within, it sees behind the
// entries.
TEST(Parallel, ACameraWithinAClosedPartNeedsEntries) {
  const Mesh mesh = test_scenes::box({-1, -1, -1}, {1, 1, 1});
  const Oracle oracle(mesh);
  const Vector along(0.125f, 0.25f, -1), d(0.25f, -0.125f, -1);
  const AllFaces camera(oracle, along), light(oracle, d);
  const Hit hit = camera.nearest({0, 0, 0});
  ASSERT_TRUE(hit.strictly_inside && hit.side == 1);
  const TruePoint point{{0, 0, 0}, along, camera.triangle(hit.face), hit.side};
  ASSERT_TRUE(facemap::is_facing_along(point.face, hit.side, d));
  EXPECT_TRUE(light.is_blocked(point));
  EXPECT_FALSE(light.is_blocked(point, is_exit));
}

}  // namespace
