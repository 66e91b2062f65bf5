#include <facemap/affine.h>
#include <facemap/error.h>
#include <facemap/model.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

using namespace facemap;

namespace {

/// Of unit rotations, and of coordinates of a few units; doubles are far better, floats are the last step.
constexpr double kRotationError = 0x1p-40;

void expect_near(const DVector& a, const DVector& b, double error = kRotationError) {
  EXPECT_NEAR(a.x, b.x, error);
  EXPECT_NEAR(a.y, b.y, error);
  EXPECT_NEAR(a.z, b.z, error);
}

/// One triangle in the plane z = 0 that faces +z, with normals and texture coordinates.
Model triangle() {
  Model model;
  model.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  model.mesh.triangles = {{0, 1, 2}};
  model.mesh.normals = {{0, 0, 1}};
  model.mesh.normal_corners = {{0, 0, 0}};
  model.mesh.texture_coordinates = {{0, 0}, {1, 0}, {0, 1}};
  model.mesh.texture_corners = {{0, 1, 2}};
  return model;
}

/// The direction that the first triangle faces.
DVector front(const Model& model) {
  const Mesh& mesh = model.mesh;
  return glm::normalize(glm::cross(DVector(mesh.vertex(0, 1)) - DVector(mesh.vertex(0, 0)),
                                   DVector(mesh.vertex(0, 2)) - DVector(mesh.vertex(0, 0))));
}

TEST(Affine, QuarterTurnsAreExact) {
  EXPECT_EQ(Affine::rotation({0, 0, 1}, 90).point({1, 2, 3}), DVector(-2, 1, 3));
  EXPECT_EQ(Affine::rotation({1, 0, 0}, -90).point({1, 2, 3}), DVector(1, 3, -2));
  EXPECT_EQ(Affine::rotation({0, 5, 0}, 180).point({1, 2, 3}), DVector(-1, 2, -3));
  EXPECT_EQ(Affine::rotation({0, 0, 2}, 270 + 720).point({1, 2, 3}), DVector(2, -1, 3));
  EXPECT_EQ(Affine::turning({0, 0, 1}, {0, 1, 0}).point({1, 2, 3}), DVector(1, 3, -2)) << "what z-up files need";
}

TEST(Affine, RotationsTurnCounterClockwise) {
  const double half = std::sqrt(0.5);
  expect_near(Affine::rotation({0, 1, 0}, 45).point({0, 0, 1}), {half, 0, half});
  expect_near(Affine::rotation({1, 1, 1}, 120).point({1, 2, 3}), {3, 1, 2});
}

TEST(Affine, TurningBringsOneDirectionToAnother) {
  expect_near(Affine::turning({1, 2, 3}, {-2, 0.5, 1}).direction(glm::normalize(DVector(1, 2, 3))),
              glm::normalize(DVector(-2, 0.5, 1)));
  EXPECT_EQ(Affine::turning({1, 2, 3}, {2, 4, 6}), Affine());
  const Affine back = Affine::turning({0, 1, 0}, {0, -3, 0});
  EXPECT_EQ(back.direction({0, 1, 0}), DVector(0, -1, 0));
  EXPECT_FALSE(back.is_mirrored());
}

TEST(Affine, RefusesWhatHasNoDirection) {
  EXPECT_THROW(Affine::rotation({0, 0, 0}, 10), Error);
  EXPECT_THROW(Affine::rotation({0, 0, 1}, std::nan("")), Error);
  EXPECT_THROW(Affine::turning({0, 0, 0}, {0, 1, 0}), Error);
}

TEST(TransformModel, MovesPositionsAndTurnsNormals) {
  const Model moved = transformed(
      triangle(), Affine::translation({1, 2, 3}) * Affine::rotation({1, 0, 0}, 90) * Affine::scaling(DVector(2)));
  EXPECT_EQ(moved.mesh.positions[1], Vector(3, 2, 3));
  EXPECT_EQ(moved.mesh.positions[2], Vector(1, 2, 5));
  EXPECT_EQ(moved.mesh.normals[0], Vector(0, -1, 0));
  expect_near(front(moved), {0, -1, 0});
}

TEST(TransformModel, NormalsStayPerpendicularUnderUnevenScales) {
  Model model = triangle();
  model.mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  model.mesh.normals = {Vector(glm::normalize(DVector(1, 1, 1)))};
  const Model scaled = transformed(model, Affine::scaling({1, 2, 4}));
  constexpr double kFloat = 0x1p-23;  // normals are floats
  expect_near(DVector(scaled.mesh.normals[0]), front(scaled), kFloat);
}

TEST(TransformModel, WhatIsMirroredKeepsItsFront) {
  const Model mirrored = transformed(triangle(), Affine::scaling({-1, 1, 1}));
  expect_near(front(mirrored), {0, 0, 1});
  EXPECT_EQ(mirrored.mesh.normals[0], Vector(0, 0, 1));
  // The texture stays on its vertices.
  const Corners& triangle = mirrored.mesh.triangles[0];
  EXPECT_EQ(mirrored.mesh.texture_corners[0], triangle);
  const Model flipped = transformed(::triangle(), Affine::scaling({1, 1, -1}));
  expect_near(front(flipped), {0, 0, -1});
  EXPECT_EQ(flipped.mesh.normals[0], Vector(0, 0, -1));
}

TEST(TransformModel, LightsAndCamerasGoAlong) {
  Model model = triangle();
  model.up = Vector(0, 0, 1);
  Light spot;
  spot.kind = Light::Kind::Spot;
  spot.position = {0, 0, 5};
  spot.has_falloff = true;
  spot.intensity = 3;
  spot.range = 10;
  model.lights = {spot};
  ModelCamera camera;
  camera.position = {0, 0, 2};
  camera.look_at = {0, 0, 0};
  model.cameras = {camera};
  const Model moved = transformed(model, Affine::turning({0, 0, 1}, {0, 1, 0}) * Affine::scaling(DVector(2)));
  EXPECT_EQ(moved.lights[0].position, Vector(0, 10, 0));
  EXPECT_EQ(moved.lights[0].direction, Vector(0, -1, 0));
  EXPECT_EQ(moved.lights[0].intensity, 12) << "twice as far, four times as strong: as bright as before";
  EXPECT_EQ(moved.lights[0].range, 20);
  EXPECT_EQ(moved.cameras[0].position, Vector(0, 4, 0));
  EXPECT_EQ(moved.cameras[0].up, Vector(0, 0, -1));
  EXPECT_EQ(moved.cameras[0].height, 4);
  EXPECT_EQ(moved.up, Vector(0, 1, 0));
}

TEST(TransformModel, RefusesWhatFlattensAndWhatIsNotFinite) {
  EXPECT_THROW(transformed(triangle(), Affine::scaling({1, 0, 1})), Error);
  EXPECT_THROW(transformed(triangle(), Affine::translation({std::nan(""), 0, 0})), Error);
}

TEST(JoinModels, NumbersWhatIsAddedBehindWhatIsThere) {
  Model a = triangle(), b = transformed(triangle(), Affine::translation({5, 0, 0}));
  a.mesh.triangle_materials = {0};
  a.materials.resize(2);
  a.images.resize(3);
  b.mesh.triangle_materials = {0};
  b.materials.resize(1);
  b.materials[0].name = "b";
  b.materials[0].normal_map.image = 1;
  b.images.resize(2);
  b.objects = {"thing"};
  b.triangle_objects = {0};
  b.up = Vector(0, 1, 0);
  append(a, b);
  EXPECT_EQ(a.mesh.triangles[1], (Corners{3, 4, 5}));
  EXPECT_EQ(a.mesh.vertex(1, 1), Vector(6, 0, 0));
  EXPECT_EQ(a.mesh.normal_corners[1], (Corners{1, 1, 1}));
  EXPECT_EQ(a.mesh.texture_corners[1], (Corners{3, 4, 5}));
  EXPECT_EQ(a.mesh.triangle_materials, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(a.materials[2].name, "b");
  EXPECT_EQ(a.materials[2].normal_map.image, 4u);
  EXPECT_FALSE(a.materials[2].diffuse_map.is_used());
  EXPECT_EQ(a.objects, (std::vector<std::string>{"thing"}));
  EXPECT_EQ(a.triangle_objects, (std::vector<std::uint32_t>{kNoIndex, 0}));
  EXPECT_EQ(a.up, Vector(0, 1, 0));
  EXPECT_EQ(Scene(std::move(a)).face_count(), 2u);
}

TEST(JoinModels, FillsWhatOneOfThemLacks) {
  Model plain;
  plain.mesh.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  plain.mesh.triangles = {{0, 1, 2}};
  plain.mesh.polygons = {0};
  Model coloured = triangle();
  coloured.mesh.colours = {Vector(0.5f), Vector(0.5f), Vector(0.5f)};
  append(plain, coloured);
  EXPECT_EQ(plain.mesh.normal_corners, (std::vector<Corners>{{kNoIndex, kNoIndex, kNoIndex}, {0, 0, 0}}));
  EXPECT_EQ(plain.mesh.colours[2], Vector(1));
  EXPECT_EQ(plain.mesh.colours[3], Vector(0.5f));
  EXPECT_EQ(plain.mesh.polygons, (std::vector<std::uint32_t>{0, 1}));
  Model empty;
  append(empty, plain);
  EXPECT_EQ(empty.mesh.triangles, plain.mesh.triangles);
}

TEST(LoadModel, ReadsEachFormatFromMemory) {
  const Model obj = parse_model("v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf 1 2 3\n", "-");
  EXPECT_EQ(obj.mesh.face_count(), 1u);
  EXPECT_EQ(obj.mesh.normals.size(), 3u) << "smoothing groups give normals";
  const Model stl = parse_model(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
      "a\n",
      "-");
  EXPECT_EQ(stl.mesh.face_count(), 1u);
  EXPECT_THROW(parse_model("nothing known", "-"), LoadError);
  ModelLimits limits;
  limits.max_bytes = 10;
  EXPECT_THROW(parse_model("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "-", {}, limits), LoadError);
}

}  // namespace
