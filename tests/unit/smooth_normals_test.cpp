#include "scene/smooth_normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace facemap {
namespace {

constexpr Corners kNone = {kNoIndex, kNoIndex, kNoIndex};

/// Two squares of one triangle pair each, at a right angle along the y axis: z = 0 for x > 0, x = 0 for z > 0.
Mesh folded_sheet(float width) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {width, 0, 0}, {width, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 0, 3}, {4, 3, 5}};
  mesh.polygons = {0, 0, 1, 1};
  return mesh;
}

Vector normal_at(const Mesh& mesh, std::size_t triangle, int corner) {
  return mesh.normals.at(mesh.normal_corners[triangle][corner]);
}

void expect_near(const Vector& a, const Vector& b) {
  constexpr float kTolerance = 1e-6f;  // of components of a unit vector: a few roundings of a float
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], kTolerance);
}

TEST(SmoothNormals, WeighByArea) {
  Mesh mesh = folded_sheet(3);
  add_smooth_normals(mesh, {{0, 1}});
  const float length = std::sqrt(10.0f);
  expect_near(normal_at(mesh, 0, 0), Vector(1 / length, 0, 3 / length));
  expect_near(normal_at(mesh, 0, 1), Vector(0, 0, 1));
  expect_near(normal_at(mesh, 3, 2), Vector(1, 0, 0));
}

TEST(SmoothNormals, AreTheSameHoweverAQuadIsCut) {
  Mesh mesh = folded_sheet(3);
  Mesh other = mesh;
  other.triangles = {{0, 1, 3}, {1, 2, 3}, {4, 0, 3}, {4, 3, 5}};
  add_smooth_normals(mesh, {{0, 1}});
  add_smooth_normals(other, {{0, 1}});
  EXPECT_EQ(normal_at(mesh, 0, 0), normal_at(other, 0, 0));
}

TEST(SmoothNormals, StayWithinTheirGroup) {
  Mesh mesh = folded_sheet(1);
  add_smooth_normals(mesh, {{0, 1}, {2, 2}});
  expect_near(normal_at(mesh, 0, 0), Vector(0, 0, 1));
  expect_near(normal_at(mesh, 2, 1), Vector(1, 0, 0));
  EXPECT_EQ(mesh.normals.size(), 8u);
}

TEST(SmoothNormals, LeaveFacesWithoutGroupFlat) {
  Mesh mesh = folded_sheet(1);
  add_smooth_normals(mesh, {{1, 4}, {2, 0}});
  EXPECT_EQ(mesh.normal_corners[0], kNone);
  EXPECT_NE(mesh.normal_corners[1][0], kNoIndex);
  EXPECT_EQ(mesh.normal_corners[2], kNone);
}

TEST(SmoothNormals, KeepNormalsThatAreThere) {
  Mesh mesh = folded_sheet(1);
  mesh.normals = {{0, 0, 5}};
  mesh.normal_corners = {{0, 0, kNoIndex}, kNone, kNone, kNone};
  add_smooth_normals(mesh, {{0, 1}});
  EXPECT_EQ(mesh.normal_corners[0][0], 0u);
  EXPECT_EQ(mesh.normals[0], Vector(0, 0, 5));
  expect_near(normal_at(mesh, 0, 2), Vector(0, 0, 1));
}

TEST(SmoothNormals, VanishWhereAreasCancel) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  add_smooth_normals(mesh, {{0, 1}});
  EXPECT_EQ(mesh.normal_corners[0], kNone);
  EXPECT_TRUE(mesh.normals.empty());
}

TEST(SmoothNormals, HoldForTheSmallestAndLargestFloats) {
  for (const float size : {1e-45f, 1e-30f, 3e38f}) {
    Mesh mesh;
    mesh.positions = {{-size, 0, 0}, {size, 0, 0}, {0, size, 0}};
    mesh.triangles = {{0, 1, 2}};
    add_smooth_normals(mesh, {{0, 7}});
    expect_near(normal_at(mesh, 0, 0), Vector(0, 0, 1));
  }
}

}  // namespace
}  // namespace facemap
