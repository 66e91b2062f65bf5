#include <facemap/error.h>
#include <facemap/generators.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <sstream>

#include "scene/generators/lathe.h"
#include "scene/generators/solids.h"

namespace facemap {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// How often each edge is walked one way more than the other; empty if the triangles close up.
std::map<Edge, int> open_edges(const std::vector<Corners>& triangles) {
  std::map<Edge, int> balance;
  for (const Corners& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      const int way = a < b ? 1 : -1;
      if ((balance[{std::min(a, b), std::max(a, b)}] += way) == 0) balance.erase({std::min(a, b), std::max(a, b)});
    }
  }
  return balance;
}

std::vector<Corners> part_triangles(const GeneratedScene& scene, std::size_t part) {
  const auto& all = scene.mesh.triangles;
  const std::size_t end = part + 1 < scene.parts.size() ? scene.parts[part + 1].first_face : all.size();
  return {all.begin() + static_cast<std::ptrdiff_t>(scene.parts[part].first_face),
          all.begin() + static_cast<std::ptrdiff_t>(end)};
}

// The signed volumes of the connected pieces of a mesh.
std::vector<double> piece_volumes(const Mesh& mesh) {
  std::vector<std::uint32_t> leader(mesh.positions.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  for (const Corners& t : mesh.triangles) {
    leader[find(t[0])] = find(t[1]);
    leader[find(t[1])] = find(t[2]);
  }
  std::map<std::uint32_t, double> volume;
  for (const Corners& t : mesh.triangles) {
    const DVector a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    volume[find(t[0])] += dot(a, cross(b, c)) / 6;
  }
  std::vector<double> volumes;
  for (const auto& [piece, v] : volume) volumes.push_back(v);
  return volumes;
}

// FNV-1a over the bytes of positions and triangles.
std::uint64_t fingerprint(const Mesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](const void* data, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) {
      hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
    }
  };
  add(mesh.positions.data(), mesh.positions.size() * sizeof(Vector));
  add(mesh.triangles.data(), mesh.triangles.size() * sizeof(Corners));
  return hash;
}

struct Expected {
  const char* name;
  std::size_t faces;
  std::uint64_t fingerprint;
};

// Wang 2022, table 1, and the fingerprints of our own models at detail 1.
constexpr Expected kExpected[] = {
    {"chessboard", 123314, 17492243700554360952u},
    {"grass", 86864, 12926936002642030573u},
    {"bust", 44590, 15830114080710880330u},
    {"typewriter", 145558, 15309158506463809088u},
};

class GeneratorTest : public testing::TestWithParam<Expected> {};

INSTANTIATE_TEST_SUITE_P(All, GeneratorTest, testing::ValuesIn(kExpected),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST_P(GeneratorTest, HasTheNumberOfFacesOfThePaper) {
  EXPECT_EQ(generate_scene(GetParam().name).mesh.face_count(), GetParam().faces);
}

TEST_P(GeneratorTest, IsTheSameOnEveryMachine) {
  EXPECT_EQ(fingerprint(generate_scene(GetParam().name).mesh), GetParam().fingerprint);
}

TEST_P(GeneratorTest, HasNoOddFaces) {
  for (int detail : {1, 2}) {
    const Scene scene(generate_scene(GetParam().name, detail).mesh);
    EXPECT_EQ(scene.odd_faces().zero_area, 0);
    EXPECT_EQ(scene.odd_faces().repeated_vertex, 0);
    EXPECT_EQ(scene.odd_faces().duplicate, 0);
  }
}

TEST_P(GeneratorTest, PartsAreClosedButForTheBladesOfGrass) {
  for (int detail : {1, 2}) {
    const GeneratedScene scene = generate_scene(GetParam().name, detail);
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
      EXPECT_EQ(open_edges(part_triangles(scene, i)).empty(), scene.parts[i].name != "blades") << scene.parts[i].name;
    }
  }
}

TEST_P(GeneratorTest, ClosedPiecesFaceOutwards) {
  GeneratedScene scene = generate_scene(GetParam().name);
  if (scene.parts.back().name == "blades") scene.mesh.triangles.resize(scene.parts.back().first_face);
  for (double volume : piece_volumes(scene.mesh)) EXPECT_GT(volume, 0);
}

TEST_P(GeneratorTest, GrowsWithTheSquareOfDetail) {
  const double once = double(generate_scene(GetParam().name, 1).mesh.face_count());
  const double twice = double(generate_scene(GetParam().name, 2).mesh.face_count());
  EXPECT_GT(twice, 2.5 * once);
  EXPECT_LT(twice, 4.5 * once);
}

TEST_P(GeneratorTest, NamesEveryFaceOnceAndUsesEveryPosition) {
  const GeneratedScene scene = generate_scene(GetParam().name);
  ASSERT_FALSE(scene.parts.empty());
  EXPECT_EQ(scene.parts[0].first_face, 0u);
  for (std::size_t i = 1; i < scene.parts.size(); ++i) {
    EXPECT_LT(scene.parts[i - 1].first_face, scene.parts[i].first_face);
  }
  EXPECT_EQ(scene.smoothing_groups.size(), scene.mesh.triangles.size());
  std::vector<char> used(scene.mesh.positions.size(), 0);
  for (const Corners& t : scene.mesh.triangles) used[t[0]] = used[t[1]] = used[t[2]] = 1;
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

TEST_P(GeneratorTest, IsSeenAndLitFromOutside) {
  const GeneratedScene generated = generate_scene(GetParam().name);
  ASSERT_EQ(generated.lights.size(), 8u);
  const Scene scene(generated.mesh);
  const auto distance = [&](const Vector& p) { return length(DVector(p) - scene.centre()); };
  EXPECT_GT(distance(generated.camera_position), scene.bounding_radius());
  for (const GeneratedScene::Light& light : generated.lights) {
    EXPECT_GT(distance(light.position), scene.bounding_radius());
    EXPECT_GT(light.intensity, 0);
  }
  EXPECT_GE(generated.field_angle_deg, 30);
  EXPECT_LE(generated.field_angle_deg, 50);
}

// The view holds the whole object: every vertex is within the field angle of the sight axis.
TEST_P(GeneratorTest, FitsIntoItsView) {
  const GeneratedScene scene = generate_scene(GetParam().name);
  const DVector eye(scene.camera_position), sight = normalize(DVector(scene.look_at) - eye);
  const DVector right = normalize(cross(sight, DVector(scene.up))), up = cross(right, sight);
  const double reach = std::tan(scene.field_angle_deg * std::acos(-1.0) / 360);
  for (const Vector& p : scene.mesh.positions) {
    const DVector d = DVector(p) - eye;
    ASSERT_LT(std::abs(dot(d, up)), reach * dot(d, sight));
    ASSERT_LT(std::abs(dot(d, right)), reach * dot(d, sight));
  }
}

TEST_P(GeneratorTest, ReadsBackFromObjAsTheSameFloats) {
  const GeneratedScene scene = generate_scene(GetParam().name);
  std::ostringstream text;
  write_obj(text, scene, "scene.obj");
  const OBJ obj = OBJ::parse(text.str(), "scene.obj", "", {});
  EXPECT_TRUE(obj.mesh().positions == scene.mesh.positions);
  EXPECT_TRUE(obj.mesh().triangles == scene.mesh.triangles);
  EXPECT_EQ(obj.report().objects, static_cast<std::int64_t>(scene.parts.size()));
  EXPECT_TRUE(obj.report().ignored.empty());
  ASSERT_EQ(obj.mesh().normal_corners.size(), scene.mesh.triangles.size());
  for (std::size_t i = 0; i < scene.mesh.triangles.size(); ++i) {
    ASSERT_EQ(obj.mesh().normal_corners[i][0] == kNoIndex, scene.smoothing_groups[i] == 0);
  }
}

TEST(Generators, AreTheFourScenesOfThePaper) {
  EXPECT_EQ(generator_names(), (std::vector<std::string>{"chessboard", "grass", "bust", "typewriter"}));
}

TEST(Generators, RefuseUnknownNamesAndDetails) {
  EXPECT_THROW(generate_scene("teapot"), Error);
  EXPECT_THROW(generate_scene("grass", 0), Error);
  EXPECT_THROW(generate_scene("grass", kMaxSceneDetail + 1), Error);
}

TEST(Generators, ChessboardHasAllPieces) {
  std::map<std::string, int> count;
  for (const auto& part : generate_scene("chessboard").parts) ++count[part.name.substr(0, part.name.rfind('_'))];
  const std::map<std::string, int> expected{
      {"board", 1},        {"white_king", 1},   {"white_queen", 1}, {"white_rook", 2},  {"white_bishop", 2},
      {"white_knight", 2}, {"white_pawn", 8},   {"black_king", 1},  {"black_queen", 1}, {"black_rook", 2},
      {"black_bishop", 2}, {"black_knight", 2}, {"black_pawn", 8}};
  EXPECT_EQ(count, expected);
}

TEST(Generators, ViewFlagsAreTheProgramsOwn) {
  GeneratedScene scene;
  scene.camera_position = {-6, 7.5f, 0.1f};
  scene.look_at = {0, -0.25f, 1};
  scene.field_angle_deg = 42.5f;
  scene.lights.push_back({{1, 2, 3}, {1, 0.5f, 0.25f}, 0.5f});
  scene.lights.push_back({{-1, 0, 1e-9f}, {1, 1, 1}, 2});
  EXPECT_EQ(view_flags(scene),
            "--camera -6,7.5,0.1 --look-at 0,-0.25,1 --up 0,1,0 --field-angle 42.5 --light 1,2,3,0.5,0.25,0.125 "
            "--light -1,0,1e-09,2,2,2");
}

TEST(Generators, ObjBeginsWithTheCommandThatShowsIt) {
  GeneratedScene scene;
  scene.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  scene.smoothing_groups = {0, 2};
  scene.parts = {{"sheet", 0}};
  std::ostringstream text;
  write_obj(text, scene, "a.obj");
  EXPECT_EQ(text.str(),
            "# facemap render a.obj --camera 0,0,0 --look-at 0,0,0 --up 0,1,0 --field-angle 45\n"
            "v 0 0 0\nv 1 0 0\nv 0 0.1 0\no sheet\ns off\nf 1 2 3\ns 2\nf 1 3 2\n");
}

TEST(Generators, WritingToABadPlaceThrows) {
  EXPECT_THROW(write_obj(std::filesystem::path("/nonexistent/a.obj"), GeneratedScene()), Error);
  std::ostringstream broken;
  broken.setstate(std::ios::badbit);
  EXPECT_THROW(write_obj(broken, GeneratedScene(), "a.obj"), Error);
}

namespace solids = generators;

void expect_closed(const solids::Solid& solid, std::size_t faces) {
  EXPECT_TRUE(open_edges(solid.triangles).empty());
  EXPECT_EQ(solid.triangles.size(), faces);
  EXPECT_EQ(solid.groups.size(), faces);
  double volume = 0;
  for (const Corners& t : solid.triangles) {
    volume += dot(solid.points[t[0]], cross(solid.points[t[1]], solid.points[t[2]])) / 6;
  }
  EXPECT_GT(volume, 0);
}

TEST(Solids, AreClosedAndFaceOutwards) {
  const solids::Outline corner{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  expect_closed(solids::box({1, 1, 1}, {2, 3, 4}, 0), 12);
  expect_closed(solids::box({1, 1, 1}, {2, 3, 4}, 0.1), 60);
  expect_closed(solids::extrude(corner, 1, 0), 20);
  expect_closed(solids::extrude(corner, 1, 0.1), 44);
  expect_closed(solids::sheet({{0, 0}, {1, 0}, {1, 1}}, 0.1, 2), 20);
  expect_closed(solids::bar({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0.1, 0.2, 0.1}, 6), 36);
  expect_closed(solids::sweep({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, 0.5, 2, 5), 44);
  expect_closed(solids::lathe(solids::Profile(0, 0, 1).line(1, 0).arc(0, 1, 0.4, 4), 7), 7 * 8);
}

TEST(Solids, StayOutwardsWhenMirrored) {
  solids::Placement mirror;
  mirror.x = {-1, 0, 0};
  expect_closed(solids::placed(solids::box({1, 1, 1}, {2, 3, 4}, 0), mirror), 12);
}

TEST(Solids, ArcsRunAlongTheirCircle) {
  const solids::Profile quarter = solids::Profile(1, 0, 3).arc(0, 1, std::tan(std::acos(-1.0) / 8), 4);
  EXPECT_EQ(quarter.points().size(), 13u);
  // A few roundings of values near 1.
  constexpr double kRounding = 0x1p-48;
  for (const glm::dvec2& p : quarter.points()) EXPECT_NEAR(length(p), 1, kRounding);
}

TEST(Solids, CreasesPartSmoothingGroups) {
  const solids::Outline square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(solids::crease_groups(square, true), (std::vector<int>{1, 2, 1, 2}));
  const solids::Outline triangle{{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ(solids::crease_groups(triangle, true), (std::vector<int>{1, 2, 3}));
  const solids::Outline bend{{0, 0}, {1, 0}, {2, 0.5}, {2, 2}};
  EXPECT_EQ(solids::crease_groups(bend, false), (std::vector<int>{1, 1, 2}));
}

}  // namespace
}  // namespace facemap
