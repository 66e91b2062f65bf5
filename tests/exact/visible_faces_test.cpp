// Which faces and vertices are visible from a point, against the referee: hard little scenes, with holes and without.
// FACEMAP_QUERIES sets the number of directions.

#include <facemap/error.h>
#include <facemap/generators.h>
#include <facemap/viewpoint.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "support/covered_pieces.h"
#include "support/cut_out_scenes.h"
#include "support/environment.h"
#include "support/holes.h"
#include "support/oracle.h"
#include "support/queries.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using test_scenes::TestScene;

constexpr int kLargestFaceCount = 60;

DVector crossed(const DVector& a, const DVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Where faces may just come into sight, and elsewhere.
class Directions {
 public:
  Directions(const TestScene& test, const Vector& origin, Random& random)
      : test_(test), origin_(origin), random_(random), count_(static_cast<int>(test.mesh.face_count())) {}

  Vector next() {
    switch (random_.below(6)) {
      case 0:
        return Vector(random_.direction());
      case 1:
        return aimed(corner());
      case 2:
        return aimed((corner() + corner()) * 0.5);
      case 3:
        return test_queries::make_camera_query(test_, origin_, random_).direction;
      case 4:
        return beside_a_crossing();
      default:
        return within_a_face();
    }
  }

 private:
  DVector corner() {
    return DVector(test_.mesh.vertex(static_cast<std::size_t>(random_.below(count_)), random_.below(3)));
  }
  Vector aimed(const DVector& point) { return Vector(point - DVector(origin_)); }

  Vector within_a_face() {
    const auto face = static_cast<std::size_t>(random_.below(count_));
    const double u = random_.unit(), v = random_.unit() * (1 - u);
    const DVector a(test_.mesh.vertex(face, 0)), b(test_.mesh.vertex(face, 1)), c(test_.mesh.vertex(face, 2));
    return aimed(a + u * (b - a) + v * (c - a));
  }

  // Where two edges seem to cross, and a little off.
  Vector beside_a_crossing() {
    const auto plane = [&] {
      const auto face = static_cast<std::size_t>(random_.below(count_));
      const int k = random_.below(3);
      return crossed(DVector(test_.mesh.vertex(face, k)) - DVector(origin_),
                     DVector(test_.mesh.vertex(face, (k + 1) % 3)) - DVector(origin_));
    };
    DVector line = crossed(plane(), plane());
    const double size = std::max({std::fabs(line.x), std::fabs(line.y), std::fabs(line.z)});
    if (!(size > 0 && std::isfinite(size))) return Vector(0);
    line = line / size + random_.in_cube() * std::exp2(random_.between(-24.0, -4.0));
    return Vector(random_.chance(0.5) ? line : -line);
  }

  const TestScene& test_;
  Vector origin_;
  Random& random_;
  int count_;
};

struct Tally {
  std::uint64_t scenes = 0, directions = 0, visible = 0, covered = 0, undecided = 0, pieces = 0, differences = 0;
};

class Session {
 public:
  explicit Session(std::uint64_t seed) : random_(seed) { std::printf("seed 0x%llx\n", (unsigned long long)seed); }
  ~Session() {
    std::printf("%llu scenes, %llu directions; faces: %llu visible, %llu covered (%llu pieces), %llu undecided\n",
                (unsigned long long)tally_.scenes, (unsigned long long)tally_.directions,
                (unsigned long long)tally_.visible, (unsigned long long)tally_.covered,
                (unsigned long long)tally_.pieces, (unsigned long long)tally_.undecided);
  }

  const Tally& ask(std::uint64_t directions, bool with_holes) {
    while (tally_.directions < directions && tally_.differences < 10) {
      const TestScene test = make_test_scene();
      ++tally_.scenes;
      if (with_holes) {
        const Scene scene(test_scenes::with_holes(test, random_));
        const oracle::Holes holes(scene.mesh(), scene.materials(), scene.images());
        std::vector<std::uint8_t> is_solid;
        for (std::size_t face = 0; face < scene.face_count(); ++face) {
          is_solid.push_back(holes.kind(static_cast<FaceId>(face)) == oracle::Holes::Kind::Solid);
        }
        compare(test, scene, oracle::Oracle(scene.mesh(), &holes), is_solid);
      } else {
        const Scene scene(test.mesh);
        compare(test, scene, oracle::Oracle(scene.mesh()), std::vector<std::uint8_t>(scene.face_count(), 1));
      }
    }
    return tally_;
  }

 private:
  // Some with a closed body, which hides much.
  TestScene make_test_scene() {
    TestScene test = test_scenes::make_any_scene(random_, kLargestFaceCount);
    if (random_.chance(0.3)) {
      const DVector c = DVector(test.centre) + random_.in_cube() * (0.5 * test.radius);
      test.mesh =
          test_scenes::joined(test_scenes::geodesic_sphere(1, c, random_.between(0.1, 0.6) * test.radius), test.mesh);
    }
    return test;
  }

  void fail(const TestScene& test, const Vector& origin, FaceId face, const std::string& what) {
    if (++tally_.differences > 10) return;
    ADD_FAILURE() << test.name << ", face " << face << ": " << what << "; "
                  << test_queries::write_failure(test.mesh, "origin " + test_queries::text(origin));
  }

  void compare(const TestScene& test, const Scene& scene, const oracle::Oracle& oracle,
               const std::vector<std::uint8_t>& is_solid) {
    const Vector origin = test_scenes::make_origin(test, random_);
    const int threads = random_.between(1, 3);
    const Viewpoint viewpoint(scene, origin, {threads});
    const VisibleFaces answers = viewpoint.visible_faces();
    const oracle::View truth = oracle.from(origin);
    ASSERT_EQ(answers.faces.size(), scene.face_count());
    for (std::size_t i = 0; i < scene.face_count(); ++i) check_face(test, viewpoint, oracle, truth, answers, i);
    check_pieces(test, viewpoint, oracle, is_solid, answers);
    Directions directions(test, origin, random_);
    for (int i = 0; i < 2000; ++i) {
      ++tally_.directions;
      const Vector d = directions.next();
      if (!(std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z))) continue;
      const oracle::Hit hit = truth.nearest(d);
      if (hit.face == kNoFace || !hit.strictly_inside) continue;
      if (answers.faces[static_cast<std::size_t>(hit.face)] == FaceVisibility::Hidden) {
        fail(test, origin, hit.face, "called hidden, but seen along " + test_queries::text(d));
      }
    }
    if (tally_.scenes % 4 == 0) check_again(scene, origin, threads, answers);
    check_vertices(test, viewpoint, truth);
  }

  void check_face(const TestScene& test, const Viewpoint& viewpoint, const oracle::Oracle& oracle,
                  const oracle::View& truth, const VisibleFaces& answers, std::size_t i) {
    const auto face = static_cast<FaceId>(i);
    const FaceVisibility answer = answers.faces[i];
    const HiddenReason reason = answers.reasons[i];
    const Vector w = answers.witnesses[i];
    tally_.visible += answer == FaceVisibility::Visible;
    tally_.covered += reason == HiddenReason::Covered;
    tally_.undecided += answer == FaceVisibility::Undecided;
    const auto fault = [&](const char* what) { fail(test, viewpoint.origin(), face, what); };
    if ((answer == FaceVisibility::Hidden) != (reason != HiddenReason::None)) fault("no reason, or one too many");
    if ((reason == HiddenReason::LeftOut) == oracle.is_kept(face)) fault("left out, or not");
    const bool is_edge_on = oracle.is_kept(face) && oracle.side(face, viewpoint.origin()) == 0;
    if ((reason == HiddenReason::EdgeOn) != is_edge_on) fault("edge-on, or not");
    if (answer != FaceVisibility::Visible) {
      if (w != Vector(0)) fault("a witness of what is not visible");
      return;
    }
    const oracle::Hit hit = truth.nearest(w);
    if (hit.face != face || !hit.strictly_inside) fault("not seen along its witness");
  }

  void check_pieces(const TestScene& test, const Viewpoint& viewpoint, const oracle::Oracle& oracle,
                    const std::vector<std::uint8_t>& is_solid, const VisibleFaces& answers) {
    const oracle::PieceReferee referee(oracle, is_solid, viewpoint.origin());
    for (std::size_t i = 0; i < answers.faces.size(); ++i) {
      const auto face = static_cast<FaceId>(i);
      const std::vector<CoveredPiece> pieces = viewpoint.covered_pieces(face);
      if (answers.reasons[i] != HiddenReason::Covered) {
        if (!pieces.empty() && answers.faces[i] != FaceVisibility::Undecided) {
          fail(test, viewpoint.origin(), face, "pieces of what is not covered");
        }
        continue;
      }
      tally_.pieces += pieces.size();
      if (pieces.size() > 200) continue;  // takes long
      if (const std::string fault = referee.fault_of(face, pieces); !fault.empty()) {
        fail(test, viewpoint.origin(), face, fault);
      }
    }
  }

  void check_again(const Scene& scene, const Vector& origin, int threads, const VisibleFaces& answers) {
    const VisibleFaces again = Viewpoint(scene, origin, {threads % 3 + 1}).visible_faces();
    EXPECT_TRUE(again.faces == answers.faces);
    EXPECT_TRUE(again.reasons == answers.reasons);
    EXPECT_TRUE(again.witnesses == answers.witnesses);
  }

  void check_vertices(const TestScene& test, const Viewpoint& viewpoint, const oracle::View& truth) {
    const std::vector<std::uint8_t> visible = viewpoint.visible_vertices();
    const std::vector<Vector>& positions = viewpoint.scene().mesh().positions;
    ASSERT_EQ(visible.size(), positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if ((visible[i] != 0) != truth.is_lit(positions[i], {})) {
        fail(test, viewpoint.origin(), kNoFace, "vertex " + std::to_string(i));
      }
    }
  }

  Random random_;
  Tally tally_;
};

TEST(VisibleFaces, EqualTheOracle) {
  Session session(number_from_environment("FACEMAP_SEED", 0x5eed0070));
  const Tally& tally = session.ask(number_from_environment("FACEMAP_QUERIES", 300'000), false);
  EXPECT_EQ(tally.differences, 0u);
  EXPECT_GT(tally.covered, 0u);
  EXPECT_GT(tally.visible, 0u);
}

TEST(VisibleFaces, EqualTheOracleWithHoles) {
  Session session(number_from_environment("FACEMAP_SEED", 0x5eed0071));
  const Tally& tally = session.ask(number_from_environment("FACEMAP_QUERIES", 300'000) / 3, true);
  EXPECT_EQ(tally.differences, 0u);
}

// At most one in a thousand.
void expect_few_undecided(const Scene& scene, const Vector& origin) {
  const VisibleFaces answers = Viewpoint(scene, origin).visible_faces();
  const auto count = [&](FaceVisibility what) { return std::count(answers.faces.begin(), answers.faces.end(), what); };
  const auto undecided = count(FaceVisibility::Undecided);
  std::printf("%zu faces: %td visible, %td hidden, %td undecided\n", answers.faces.size(),
              count(FaceVisibility::Visible), count(FaceVisibility::Hidden), undecided);
  EXPECT_LE(1000 * static_cast<std::size_t>(undecided), answers.faces.size());
}

TEST(VisibleFaces, FewOfTheChessboardAreUndecided) {
  const GeneratedScene made = generate_scene("chessboard");
  const Scene scene(made.mesh);
  expect_few_undecided(scene, made.camera_position);
  expect_few_undecided(scene, made.lights[0].position);
  expect_few_undecided(scene, {0.3f, 0.5f, 0.2f});  // among the pieces
}

// A closed box that is turned inside out: what is seen of it is turned away.
TEST(VisibleFaces, FacesTurnedAwayMayBeSeen) {
  Mesh mesh = test_scenes::box({-1, -1, -1}, {1, 1, 1});
  for (Corners& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  const Scene scene(mesh);
  const VisibleFaces answers = Viewpoint(scene, {3, 4, 5}).visible_faces();
  EXPECT_EQ(std::count(answers.faces.begin(), answers.faces.end(), FaceVisibility::Visible), 6);
  EXPECT_EQ(std::count(answers.faces.begin(), answers.faces.end(), FaceVisibility::Hidden), 6);
}

// A tent before a face reaches down to it in one point. There the face wins if its number is lower, as they are turned
// the same way: then it may not be called hidden.
TEST(VisibleFaces, AFaceThatWinsInOnePointIsNotHidden) {
  const auto add_tent = [](Mesh& mesh) {
    const Vector corners[] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    for (int i = 0; i < 4; ++i) test_scenes::add_triangle(mesh, corners[i], corners[(i + 1) % 4], {0, 0, 2});
  };
  const auto add_floor = [](Mesh& mesh) {
    test_scenes::add_triangle(mesh, {-0.4f, -0.4f, 2}, {0.8f, -0.4f, 2}, {-0.4f, 0.9f, 2});
  };
  Mesh floor_first, tent_first;
  add_floor(floor_first);
  add_tent(floor_first);
  add_tent(tent_first);
  add_floor(tent_first);
  const Scene floor_scene(floor_first), tent_scene(tent_first);
  EXPECT_NE(Viewpoint(floor_scene, Vector(0)).visible_faces().faces[0], FaceVisibility::Hidden);
  EXPECT_EQ(Viewpoint(tent_scene, Vector(0)).visible_faces().faces[4], FaceVisibility::Hidden);
}

TEST(VisibleFaces, FacesSeenEdgeOnAreAllThereIs) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, {1, 0, 0}, {2, 0, 0}, {1, 1, 0});
  const Scene scene(mesh);
  const VisibleFaces answers = Viewpoint(scene, Vector(0)).visible_faces([](double done) { return done >= 0; });
  EXPECT_EQ(answers.faces, std::vector(1, FaceVisibility::Hidden));
  EXPECT_EQ(answers.reasons, std::vector(1, HiddenReason::EdgeOn));
}

TEST(VisibleFaces, StopWhenTold) {
  const Scene scene(generate_scene("bust").mesh);
  const Viewpoint viewpoint(scene, {0, 0, 100});
  EXPECT_THROW(viewpoint.visible_faces([](double) { return false; }), Error);
  EXPECT_THROW(viewpoint.covered_pieces(-1), Error);
  EXPECT_THROW(viewpoint.covered_pieces(static_cast<FaceId>(scene.face_count())), Error);
}

}  // namespace
