// Every OBJ file of the collection of test models is read or refused with a reason, and what was counted in it by
// other means (facts.jsonl) agrees.

#include <facemap/error.h>
#include <facemap/obj.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "math/exact_sign.h"

namespace facemap {
namespace {

using Cause = LoadError::Cause;

/// Files that have to be refused, and why. "no normals", "no texture coordinates" mean that faces name some.
const std::map<std::string, Cause> kRefused = {
    {"nasty/assimp/box_UTF16BE.obj", Cause::BadEncoding},
    {"nasty/assimp/number_formats.obj", Cause::BadNumber},  // 3.1+e2
    {"nasty/assimp/point_cloud.obj", Cause::NoFaces},
    {"nasty/assimp/testline.obj", Cause::NoFaces},
    {"nasty/assimp/testpoints.obj", Cause::NoFaces},
    {"nasty/pywavefront/simple_one_vertex.obj", Cause::NoFaces},
    {"nasty/pywavefront/simple_zero_indices.obj", Cause::BadIndex},       // normal 0
    {"nasty/tinyobjloader/catmark_torus_creases0.obj", Cause::BadIndex},  // no normals
    {"nasty/tinyobjloader/invalid-face-definition.obj", Cause::TruncatedStatement},
    {"nasty/tinyobjloader/invalid-relative-texture-index.obj", Cause::BadIndex},
    {"nasty/tinyobjloader/invalid-relative-vertex-index.obj", Cause::BadIndex},
    {"nasty/tinyobjloader/issue-140-zero-face-idx.obj", Cause::BadIndex},
    {"nasty/tinyobjloader/issue-356-leading-spaces-newmtl.obj", Cause::NoFaces},
    {"nasty/tinyobjloader/line-prim.obj", Cause::NoFaces},
    {"nasty/tinyobjloader/points-prim.obj", Cause::NoFaces},
    {"nasty/tinyobjloader/smoothing-group-two-squares.obj", Cause::BadIndex},  // no normals
    {"nasty/tinyobjloader/test-nan.obj", Cause::BadNumber},
    {"nasty/wavefront_spec/bezier_patch.obj", Cause::NoFaces},
    {"nasty/wavefront_spec/cardinal_curve.obj", Cause::NoFaces},
};

/// Faces of zero area where we differ from facts.jsonl, which looked at decimals as written, and at faces of the
/// file as a whole. Corners that are on one line as decimals are not as floats (0.01 0.02 0.03, 0.04 0.05 0.06,
/// 0.07 0.08 0.09), and a face that crosses itself so that its areas cancel is not on one line.
const std::map<std::string, std::int64_t> kZeroAreaFaces = {
    {"nasty/pywavefront/arbitrary-faces.obj", 0},  // facts: 3, one by decimals and two that cross themselves
    {"nasty/pywavefront/simple.obj", 0},           // facts: 1 or 2, all by decimals, in this and the next
    {"nasty/pywavefront/simple_colors.obj", 0},
    {"nasty/pywavefront/simple_extra_empty_lines.obj", 0},
    {"nasty/pywavefront/simple_missing_material.obj", 0},
    {"nasty/pywavefront/simple_missing_normal.obj", 0},
    {"nasty/pywavefront/simple_missing_uv.obj", 0},
    {"nasty/pywavefront/simple_negative_indices.obj", 0},
    {"nasty/pywavefront/simple_no_mtl.obj", 0},
    {"nasty/pywavefront/simple_no_object_no_mtl.obj", 0},
    {"nasty/pywavefront/simple_normals.obj", 0},
    {"nasty/pywavefront/simple_positions.obj", 0},
    {"nasty/pywavefront/simple_vt.obj", 0},
    {"scenes/hotel_room/hotel_room.obj", 463},  // facts: 464; exact fractions of the floats: 463
};

/// Duplicates where we differ from facts.jsonl, which counts faces of the file that name the same vertices. Ours are
/// triangles with the same positions: halves of quads, and faces of vertices that are there twice.
const std::map<std::string, std::int64_t> kDuplicates = {
    {"nasty/assimp/box_longline.obj", 466},  // one face of 936 corners that goes round and round
    {"nasty/assimp/regr01.obj", 3},
    {"nasty/assimp/regr_3429812.obj", 2},  // a quad, and its halves as triangles
    {"nasty/furniture/cartoon_biplane/cartoon_biplane.obj", 1},
    {"nasty/furniture/chairWithCushion/chairWithCushion.obj", 6},
    {"nasty/furniture/radiator3/radiator3.obj", 2},
    {"nasty/pywavefront/arbitrary-faces.obj", 6},
    {"nasty/pywavefront/simple_no_mtl.obj", 1},
    {"nasty/pywavefront/simple_no_object_no_mtl.obj", 1},
    {"scenes/chandelier-lamp/chandelier-lamp.obj", 810},
    {"scenes/hotel_room/hotel_room.obj", 119},
    {"scenes/poolTable/poolTable.obj", 760},
    {"scenes/spider_plant/spider_plant.obj", 6900},
};

/// Faces of the file that name a vertex twice, as triangles that do. The other files with such faces are polygons
/// with a bridge to a hole, which are cut so that no triangle does.
const std::map<std::string, std::int64_t> kRepeatedVertex = {
    {"nasty/assimp/box_longline.obj", 466},
};

/// One file's line of facts.jsonl: flat "key": number pairs are enough for us.
class Facts {
 public:
  explicit Facts(std::string line) : line_(std::move(line)) {}

  std::optional<std::int64_t> number(const std::string& key) const {
    const std::size_t at = line_.find("\"" + key + "\": ");
    if (at == std::string::npos) return std::nullopt;
    return std::atoll(line_.c_str() + at + key.size() + 4);
  }

  std::string path() const {
    const std::string head = "{\"path\": \"";
    return line_.substr(head.size(), line_.find('"', head.size()) - head.size());
  }

 private:
  std::string line_;
};

std::filesystem::path models_folder() {
  const char* const variable = std::getenv("FACEMAP_MODELS");
  return variable != nullptr ? variable : FACEMAP_SOURCE_DIR "/../shared/models";
}

std::map<std::string, Facts> read_facts(const std::filesystem::path& folder) {
  std::map<std::string, Facts> facts;
  std::ifstream file(folder / "facts.jsonl");
  for (std::string line; std::getline(file, line);) {
    const Facts one(line);
    if (one.path().ends_with(".obj")) facts.emplace(one.path(), one);
  }
  return facts;
}

/// Faces of the file (not triangles) all of whose triangles are of zero area.
std::int64_t count_zero_area_faces(const Mesh& mesh) {
  std::map<std::uint32_t, bool> is_zero;
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i) {
    bool& zero = is_zero.emplace(mesh.polygons.empty() ? i : mesh.polygons[i], true).first->second;
    zero = zero && is_degenerate(mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2));
  }
  return std::count_if(is_zero.begin(), is_zero.end(), [](const auto& entry) { return entry.second; });
}

std::int64_t value_or(const std::map<std::string, std::int64_t>& table, const std::string& path,
                      std::int64_t otherwise) {
  const auto found = table.find(path);
  return found == table.end() ? otherwise : found->second;
}

void compare(const std::string& path, const Facts& facts, OBJ obj) {
  const OBJ::Report report = obj.report();
  EXPECT_EQ(report.vertices, facts.number("v"));
  EXPECT_EQ(report.texture_coordinates, facts.number("vt"));
  EXPECT_EQ(report.normals, facts.number("vn"));
  EXPECT_EQ(report.polygons, facts.number("faces"));
  EXPECT_EQ(report.triangles, facts.number("tris"));
  EXPECT_EQ(report.objects, facts.number("o"));
  EXPECT_EQ(report.groups, facts.number("g"));
  for (const char* statement : {"l", "p"}) {
    const auto found = std::find_if(report.ignored.begin(), report.ignored.end(),
                                    [&](const OBJ::Ignored& ignored) { return ignored.statement == statement; });
    EXPECT_EQ(found == report.ignored.end() ? 0 : found->count, facts.number(statement)) << statement;
  }

  const Scene scene(std::move(obj).mesh(), obj.materials());
  const std::int64_t zero_area = facts.number("zero_area").value_or(-1),
                     duplicates = facts.number("dup_faces").value_or(-1);
  EXPECT_EQ(count_zero_area_faces(scene.mesh()), value_or(kZeroAreaFaces, path, zero_area));
  EXPECT_EQ(scene.odd_faces().duplicate, value_or(kDuplicates, path, duplicates));
  EXPECT_EQ(scene.odd_faces().repeated_vertex, value_or(kRepeatedVertex, path, 0));
}

TEST(ObjModels, AreReadOrRefusedWithAReason) {
  const std::filesystem::path folder = models_folder();
  if (!std::filesystem::exists(folder / "facts.jsonl")) {
    std::cout << "skipped: no test models in " << folder << '\n';
    return;
  }
  const std::map<std::string, Facts> facts = read_facts(folder);
  int read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    const std::string path = std::filesystem::relative(entry.path(), folder).string();
    SCOPED_TRACE(path);
    const auto refused = kRefused.find(path);
    try {
      OBJ obj = OBJ::load(entry.path());
      EXPECT_EQ(refused, kRefused.end()) << "was read";
      ASSERT_TRUE(facts.count(path));
      compare(path, facts.at(path), std::move(obj));
      ++read;
    } catch (const LoadError& error) {
      ASSERT_NE(refused, kRefused.end()) << error.what();
      EXPECT_EQ(error.cause(), refused->second) << error.what();
    }
  }
  std::cout << read << " files read, " << kRefused.size() << " refused\n";
}

}  // namespace
}  // namespace facemap
