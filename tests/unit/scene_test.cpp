#include <facemap/error.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace facemap {
namespace {

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {100, 100, 100}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// A file in the folder for temporary files, gone at the end of the test.
struct TemporaryFile {
  std::filesystem::path path;
  TemporaryFile(const std::string& name, const std::string& text)
      : path(std::filesystem::path(testing::TempDir()) / ("facemap_scene_test_" + name)) {
    std::ofstream(path) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

TEST(Scene, BoundsAreOfKeptFacesAlone) {
  Mesh mesh = triangle();
  mesh.triangles.push_back({3, 3, 0});  // odd
  const Scene scene(std::move(mesh));
  EXPECT_EQ(scene.lower(), Vector(0, 0, 0));
  EXPECT_EQ(scene.upper(), Vector(2, 4, 0));
  EXPECT_EQ(scene.centre(), DVector(1, 2, 0));
  EXPECT_DOUBLE_EQ(scene.bounding_radius(), std::sqrt(5.0));
  EXPECT_EQ(scene.kept_faces(), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(scene.is_kept(0));
  EXPECT_FALSE(scene.is_kept(1));
  EXPECT_EQ(scene.face_count(), 2u);
  EXPECT_EQ(scene.odd_faces().repeated_vertex, 1);
}

TEST(Scene, WithoutKeptFacesIsBoundedByAllPositions) {
  Mesh mesh = triangle();
  mesh.triangles = {{0, 0, 1}};
  const Scene scene(std::move(mesh));
  EXPECT_EQ(scene.upper(), Vector(100, 100, 100));
  EXPECT_TRUE(scene.kept_faces().empty());
}

TEST(Scene, HoldsTheLargestFloats) {
  constexpr float kMax = std::numeric_limits<float>::max();
  Mesh mesh;
  mesh.positions = {{-kMax, -kMax, 0}, {kMax, -kMax, 0}, {0, kMax, kMax}};
  mesh.triangles = {{0, 1, 2}};
  const Scene scene(std::move(mesh));
  EXPECT_TRUE(std::isfinite(scene.bounding_radius()));
  EXPECT_EQ(scene.kept_faces().size(), 1u);
}

TEST(Scene, RefusesWhatIsNoMesh) {
  EXPECT_THROW(Scene{Mesh()}, Error);
  const auto expect_refused = [](auto&& spoil) {
    Mesh mesh = triangle();
    spoil(mesh);
    EXPECT_THROW(Scene{std::move(mesh)}, Error);
  };
  expect_refused([](Mesh& mesh) { mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN(); });
  expect_refused([](Mesh& mesh) { mesh.positions[0].x = std::numeric_limits<float>::infinity(); });
  expect_refused([](Mesh& mesh) { mesh.triangles[0][1] = 4; });
  expect_refused([](Mesh& mesh) { mesh.triangles[0][1] = kNoIndex; });
  expect_refused([](Mesh& mesh) { mesh.colours = {{1, 1, 1}}; });
  expect_refused([](Mesh& mesh) { mesh.polygons = {0, 0}; });
  expect_refused([](Mesh& mesh) { mesh.triangle_materials = {0}; });
  expect_refused([](Mesh& mesh) { mesh.normal_corners = {{0, 0, 0}}; });
  expect_refused([](Mesh& mesh) { mesh.texture_corners = {{kNoIndex, 0, kNoIndex}}; });
}

TEST(Scene, TakesAbsentNormalsTexturesAndMaterials) {
  Mesh mesh = triangle();
  mesh.normal_corners = mesh.texture_corners = {{kNoIndex, kNoIndex, kNoIndex}};
  mesh.triangle_materials = {kNoIndex};
  EXPECT_NO_THROW(Scene(std::move(mesh)));
}

TEST(Scene, LoadsObjFilesWhateverTheCaseOfTheirExtension) {
  const TemporaryFile file("a.ObJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\nf 3 2 1\n");
  const Scene scene = Scene::load(file.path);
  EXPECT_EQ(scene.face_count(), 2u);
  EXPECT_EQ(scene.odd_faces().duplicate, 1);
  EXPECT_EQ(scene.report().vertices, 3);
  ASSERT_EQ(scene.report().ignored.size(), 1u);
}

LoadError::Cause load_failure(const std::filesystem::path& path) {
  try {
    Scene::load(path);
  } catch (const LoadError& error) {
    EXPECT_EQ(error.file(), path.string());
    return error.cause();
  }
  ADD_FAILURE() << path << " was read";
  return LoadError::Cause::NoFaces;
}

TEST(Scene, RefusesFilesItDoesNotKnowOrFind) {
  const TemporaryFile other("model.fbx", "Kaydara FBX Binary  "), nothing("model", "");
  EXPECT_EQ(load_failure(other.path), LoadError::Cause::UnknownFormat);
  EXPECT_EQ(load_failure(nothing.path), LoadError::Cause::UnknownFormat);
  EXPECT_EQ(load_failure("/nonexistent/model.fbx"), LoadError::Cause::CannotOpen);
  EXPECT_EQ(load_failure("/nonexistent/model.obj"), LoadError::Cause::CannotOpen);
  std::filesystem::create_directories(std::filesystem::path(testing::TempDir()) / "facemap_folder.obj");
  EXPECT_EQ(load_failure(std::filesystem::path(testing::TempDir()) / "facemap_folder.obj"),
            LoadError::Cause::CannotOpen);
  const TemporaryFile empty("empty.obj", "");
  EXPECT_EQ(load_failure(empty.path), LoadError::Cause::NoFaces);
}

}  // namespace
}  // namespace facemap
