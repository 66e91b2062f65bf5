#include "scene/face_neighbours.h"

#include <gtest/gtest.h>

namespace facemap {
namespace {

Mesh mesh_of(std::vector<Vector> positions, std::vector<Corners> triangles) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return mesh;
}

const std::vector<Vector> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(FaceNeighbours, ShareAnEdgeInOppositeDirections) {
  const Scene scene(mesh_of(kSquare, {{0, 1, 2}, {0, 2, 3}}));
  const auto neighbours = find_face_neighbours(scene);
  EXPECT_EQ(neighbours[0], (FaceNeighbours{kNoNeighbour, kNoNeighbour, 1}));
  EXPECT_EQ(neighbours[1], (FaceNeighbours{0, kNoNeighbour, kNoNeighbour}));
}

TEST(FaceNeighbours, AreWeldedByPosition) {
  std::vector<Vector> positions = kSquare;
  positions.push_back({0, 0, 0});
  positions.push_back({1, 1, -0.0f});
  const Scene scene(mesh_of(positions, {{0, 1, 2}, {5, 6, 3}}));
  EXPECT_EQ(find_face_neighbours(scene)[0][2], 1u);
}

TEST(FaceNeighbours, AreNoneWhereThreeFacesMeetOrDirectionsAgree) {
  const Scene fin(mesh_of(kSquare, {{0, 1, 2}, {0, 2, 3}, {2, 0, 4}}));
  for (const FaceNeighbours& of_face : find_face_neighbours(fin)) {
    EXPECT_EQ(of_face, (FaceNeighbours{kNoNeighbour, kNoNeighbour, kNoNeighbour}));
  }
  const Scene turned(mesh_of(kSquare, {{0, 1, 2}, {2, 0, 3}}));
  EXPECT_EQ(find_face_neighbours(turned)[0][2], kNoNeighbour);
}

TEST(FaceNeighbours, LeaveOutFacesThatAreNotKept) {
  const Scene scene(mesh_of(kSquare, {{0, 1, 2}, {2, 0, 0}, {0, 2, 3}}));
  EXPECT_EQ(find_face_neighbours(scene)[0][2], 2u);
  EXPECT_EQ(find_face_neighbours(scene)[1], (FaceNeighbours{kNoNeighbour, kNoNeighbour, kNoNeighbour}));
}

}  // namespace
}  // namespace facemap
