// Every glTF file of the collection of test models is read or refused with a reason; what was counted in it by other
// means agrees.

#include <facemap/error.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>

#include "scene/gltf.h"

namespace facemap {
namespace {

using Cause = LoadError::Cause;

/// Files that have to be refused, and why. All others that are not in kRead hold no mesh: lights alone.
const std::map<std::string, Cause> kRefused = {
    {"assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", Cause::BadNumber},
    {"assimp/IndexOutOfRange/AllIndicesOutOfRange.gltf", Cause::BadIndex},
    {"assimp/IndexOutOfRange/IndexOutOfRange.gltf", Cause::BadIndex},
    {"assimp/MissingBin/BoxTextured.gltf", Cause::CannotOpen},
    {"assimp/RecursiveNodes/RecursiveNodes.gltf", Cause::BadIndex},
    {"assimp/wrongTypes/badArray.gltf", Cause::BadValue},
    {"assimp/wrongTypes/badExtension.gltf", Cause::BadValue},
    {"assimp/wrongTypes/badNumber.gltf", Cause::BadValue},
    {"assimp/wrongTypes/badObject.gltf", Cause::BadValue},
    {"assimp/wrongTypes/badUint.gltf", Cause::BadValue},
    // A node's light without an index, or one that is not there:
    {"lights_json/node/empty_object.gltf", Cause::BadValue},
    {"lights_json/node/unresolved_light_empty_root_array.gltf", Cause::BadIndex},
    {"lights_json/node/unresolved_light_empty_root_ext.gltf", Cause::BadIndex},
    {"lights_json/node/unresolved_light_no_root_ext.gltf", Cause::BadIndex},
};

struct Counts {
  std::size_t faces, positions, materials, images, lights, cameras, objects, warnings;
  friend bool operator==(const Counts&, const Counts&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << c.faces << " faces, " << c.positions << " positions, " << c.materials << " materials, " << c.images
               << " images, " << c.lights << " lights, " << c.cameras << " cameras, " << c.objects << " objects, "
               << c.warnings << " warnings";
  }
};

const std::map<std::string, Counts> kRead = {
    {"assimp/BoxTextured-glTF-Binary/BoxTextured.glb", {12, 24, 1, 1, 0, 0, 1, 0}},
    {"assimp/BoxTextured-glTF-Embedded/BoxTextured.gltf", {12, 24, 1, 1, 0, 0, 1, 0}},
    {"assimp/BoxTextured-glTF/BoxTextured.gltf", {12, 24, 1, 1, 0, 0, 1, 0}},
    {"assimp/cameras/Cameras.gltf", {2, 4, 0, 0, 0, 2, 1, 0}},
    {"assimp/wrongTypes/badString.gltf", {12, 24, 1, 1, 0, 0, 1, 0}},  // a name that nothing uses
    {"bridge_garden/bridge_garden.glb", {21883, 41980, 13, 0, 0, 0, 1, 0}},
    {"kaykit/wall_decorated.gltf", {3880, 4689, 1, 1, 0, 0, 1, 0}},
    {"sphere_lights/sphere_lights.gltf", {224, 231, 1, 2, 4, 0, 1, 0}},
};

std::filesystem::path models_folder() {
  const char* const variable = std::getenv("FACEMAP_MODELS");
  return variable != nullptr ? variable : FACEMAP_SOURCE_DIR "/../shared/models";
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void check(const std::string& path, Model model) {
  const auto counts = kRead.find(path);
  EXPECT_EQ((Counts{model.mesh.face_count(), model.mesh.positions.size(), model.materials.size(), model.images.size(),
                    model.lights.size(), model.cameras.size(), model.objects.size(), model.warnings.size()}),
            counts == kRead.end() ? Counts{} : counts->second);
  for (const std::string& warning : model.warnings) std::cout << warning << '\n';
  EXPECT_EQ(model.up, Vector(0, 1, 0));
  const Scene scene(std::move(model.mesh), std::move(model.materials));  // throws Error if it is not sound
  EXPECT_GT(scene.kept_faces().size(), 0u);
}

TEST(GltfModels, AreReadOrRefusedWithAReason) {
  const std::filesystem::path folder = models_folder() / "gltf";
  if (!std::filesystem::exists(folder)) {
    std::cout << "skipped: no test models in " << folder << '\n';
    return;
  }
  std::size_t read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
    const std::string path = std::filesystem::relative(entry.path(), folder).string();
    SCOPED_TRACE(path);
    const auto refused = kRefused.find(path);
    const Cause cause = refused != kRefused.end() ? refused->second : Cause::NoFaces;
    try {
      check(path, read_gltf(read_bytes(entry.path()), path, entry.path().parent_path()));
      ++read;
    } catch (const LoadError& error) {
      EXPECT_EQ(kRead.count(path), 0u) << error.what();
      EXPECT_EQ(error.cause(), cause) << error.what();
      std::cout << error.what() << '\n';
    }
  }
  EXPECT_EQ(read, kRead.size());
}

}  // namespace
}  // namespace facemap
