#include <facemap/error.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace facemap;
namespace fs = std::filesystem;

Scene load(const std::string& text) {
  std::string name = (fs::temp_directory_path() / "facemap-objects-XXXXXX").string();
  const fs::path folder = mkdtemp(name.data());
  std::ofstream(folder / "a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n" << text;
  Scene scene = Scene::load(folder / "a.obj");
  fs::remove_all(folder);
  return scene;
}

std::vector<std::uint32_t> objects_of(const Scene& scene) {
  std::vector<std::uint32_t> objects;
  for (std::size_t face = 0; face < scene.face_count(); ++face) objects.push_back(scene.object_of(face));
  return objects;
}

TEST(ObjObjects, AreWhatTheFileNames) {
  const Scene scene =
      load("f 1 2 3\no first one\ng parts\nf 1 2 3\nf 1 2 4 3\no second\no third\nf 2 3 4\no first one\nf 1 3 4\n");
  EXPECT_EQ(scene.objects(), (std::vector<std::string>{"first one", "second", "third"}));
  EXPECT_EQ(objects_of(scene), (std::vector<std::uint32_t>{kNoIndex, 0, 0, 0, 2, 0}));
}

TEST(ObjObjects, AreGroupsIfNoObjectIsNamed) {
  const Scene scene = load("g a\nf 1 2 3\ng b\nf 1 2 4\n");
  EXPECT_EQ(scene.objects(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(objects_of(scene), (std::vector<std::uint32_t>{0, 1}));
}

TEST(ObjObjects, MayBeAbsent) {
  const Scene scene = load("f 1 2 3\n");
  EXPECT_TRUE(scene.objects().empty());
  EXPECT_EQ(scene.object_of(0), kNoIndex);
}

TEST(ObjObjects, OfAModelAreChecked) {
  Model model;
  model.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  model.mesh.triangles = {{0, 1, 2}};
  model.objects = {"a"};
  model.triangle_objects = {1};
  EXPECT_THROW(Scene{model}, Error);
  model.triangle_objects = {0, 0};
  EXPECT_THROW(Scene{model}, Error);
  model.triangle_objects = {0};
  EXPECT_EQ(Scene(model).object_of(0), 0u);
}

}  // namespace
