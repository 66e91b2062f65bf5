// Every PLY and STL file of the collection of test models is read, with the counts that its own header or text gives,
// or refused with a reason.

#include <facemap/error.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

namespace facemap {
namespace {

using Cause = LoadError::Cause;

const std::map<std::string, Cause> kRefused = {
    {"ply/assimp/issue623.ply", Cause::NoFaces},               // its faces' list stands among the vertices' properties
    {"ply/assimp/payload_JVN42386607", Cause::UnknownFormat},  // two elements "vertex"
    {"ply/assimp/points.ply", Cause::NoFaces},
};

struct Counts {
  std::int64_t vertices, polygons, triangles, objects;
  std::int64_t warnings;
};

/// STL: vertices are those of different values (counted by a program of its own).
const std::map<std::string, Counts> kCounts = {
    {"ply/assimp/Wuson.ply", {11184, 3732, 3732, 0, 1}},  // "Created by ..." without "comment"
    {"ply/assimp/cube.ply", {8, 6, 12, 0, 0}},
    {"ply/assimp/cube_binary.ply", {8, 12, 12, 0, 0}},
    {"ply/assimp/cube_binary_header_with_RN_newline.ply", {8, 12, 12, 0, 0}},
    {"ply/assimp/cube_binary_starts_with_nl.ply", {8, 6, 12, 0, 0}},
    {"ply/assimp/cube_uv.ply", {24, 6, 12, 0, 0}},
    {"ply/assimp/float-color.ply", {3, 1, 1, 0, 0}},
    {"stl/assimp/3DSMaxExport.STL", {1042, 2000, 2000, 0, 0}},
    {"stl/assimp/Spider_ascii.stl", {722, 1368, 1368, 1, 1}},
    {"stl/assimp/Spider_binary.stl", {722, 1368, 1368, 0, 1}},
    {"stl/assimp/Wuson.stl", {2117, 3732, 3732, 0, 1}},
    {"stl/assimp/formatDetection", {3, 1, 1, 1, 0}},
    {"stl/assimp/sphereWithHole.stl", {146, 285, 285, 1, 0}},
    {"stl/assimp/triangle.stl", {3, 1, 1, 1, 0}},
    {"stl/assimp/triangle_with_empty_solid.stl", {3, 1, 1, 2, 0}},
    {"stl/assimp/triangle_with_two_solids.stl", {6, 2, 2, 2, 0}},
    {"stl/cad/featuretype.STL", {2010, 3476, 3476, 0, 0}},
};

std::filesystem::path models_folder() {
  const char* const variable = std::getenv("FACEMAP_MODELS");
  return variable != nullptr ? variable : FACEMAP_SOURCE_DIR "/../shared/models";
}

TEST(PlyStlModels, AreReadOrRefusedWithAReason) {
  const std::filesystem::path folder = models_folder();
  if (!std::filesystem::exists(folder / "ply")) {
    std::cout << "skipped: no test models in " << folder << '\n';
    return;
  }
  std::size_t read = 0, refused = 0;
  for (const char* kind : {"ply", "stl"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / kind)) {
      if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
      const std::string path = std::filesystem::relative(entry.path(), folder).string();
      SCOPED_TRACE(path);
      try {
        const Scene scene = Scene::load(entry.path());
        const OBJ::Report& report = scene.report();
        ++read;
        ASSERT_TRUE(kCounts.count(path)) << report.vertices << ", " << report.polygons << ", " << report.triangles
                                         << ", " << report.objects << ", " << report.warnings.size();
        const Counts& counts = kCounts.at(path);
        EXPECT_EQ(report.vertices, counts.vertices);
        EXPECT_EQ(report.polygons, counts.polygons);
        EXPECT_EQ(report.triangles, counts.triangles);
        EXPECT_EQ(report.objects, counts.objects);
        EXPECT_EQ(static_cast<std::int64_t>(report.warnings.size()), counts.warnings);
      } catch (const LoadError& error) {
        ++refused;
        ASSERT_TRUE(kRefused.count(path)) << error.what();
        EXPECT_EQ(error.cause(), kRefused.at(path)) << error.what();
      }
    }
  }
  EXPECT_EQ(read, kCounts.size());
  EXPECT_EQ(refused, kRefused.size());
  std::cout << read << " files read, " << refused << " refused\n";
}

}  // namespace
}  // namespace facemap
