// Materials and textures of the test models: how many there are, and that each can be decoded.

#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "material/material_table.h"

namespace facemap {
namespace {

struct Expected {
  const char* path;
  std::size_t materials, images;
  std::size_t textured;  // materials with a texture
};

const Expected kModels[] = {
    {"scenes/poolTable/poolTable.obj", 27, 17, 17},
    {"scenes/hotel_room/hotel_room.obj", 11, 6, 6},
    {"scenes/typewriter_1930s/typewriter_1930s.obj", 1, 1, 1},
    {"scenes/copperBeech/copperBeech.obj", 3, 1, 3},
    {"scenes/coconutTree/coconutTree.obj", 3, 1, 3},
    {"scenes/spider_plant/spider_plant.obj", 3, 1, 1},
    {"scenes/kaykit/crate_buns.obj", 1, 1, 1},
    {"scenes/kaykit/wall_decorated.obj", 1, 1, 1},
    {"gltf/kaykit/wall_decorated.gltf", 1, 1, 1},
    {"gltf/assimp/BoxTextured-glTF-Embedded/BoxTextured.gltf", 1, 1, 1},
};

TEST(ModelTextures, AreFoundAndDecoded) {
  const char* const variable = std::getenv("FACEMAP_MODELS");
  const std::filesystem::path folder = variable != nullptr ? variable : FACEMAP_SOURCE_DIR "/../shared/models";
  if (!std::filesystem::exists(folder / "facts.jsonl")) {
    std::cout << "skipped: no test models in " << folder << '\n';
    return;
  }
  for (const Expected& expected : kModels) {
    SCOPED_TRACE(expected.path);
    const Scene scene = Scene::load(folder / expected.path);
    EXPECT_EQ(scene.materials().size(), expected.materials);
    EXPECT_EQ(scene.images().size(), expected.images);
    const MaterialTable table(scene, std::uint64_t{1} << 26, Executor(2));
    EXPECT_TRUE(table.warnings().empty()) << table.warnings()[0];
    std::size_t textured = 0;
    for (const Material& material : scene.materials()) textured += material.diffuse_map.is_used();
    EXPECT_EQ(textured, expected.textured);
  }
}

}  // namespace
}  // namespace facemap
