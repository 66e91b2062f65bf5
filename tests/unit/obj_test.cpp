#include <facemap/error.h>
#include <facemap/obj.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace facemap {
namespace {

using Cause = LoadError::Cause;

OBJ parse(const std::string& text, const OBJ::Limits& limits = OBJ::Limits()) {
  return OBJ::parse(text, "test.obj", "", limits);
}

const std::string kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kFourVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kFace = "f 1 2 3\n";

void expect_refused(const std::string& text, Cause cause, std::int64_t line,
                    const OBJ::Limits& limits = OBJ::Limits()) {
  try {
    parse(text, limits);
    ADD_FAILURE() << "was read: " << text;
  } catch (const LoadError& error) {
    EXPECT_EQ(error.cause(), cause) << text << error.what();
    EXPECT_EQ(error.line(), line) << text << error.what();
    EXPECT_EQ(error.file(), "test.obj");
  }
}

// Vertices.

TEST(Obj, ReadsVerticesWithWeightOrColour) {
  const OBJ obj = parse("v 1 2 3 0.5\nv 4 5 6 0.1 0.2 0.3\nv 7 8 9 2 0.4 0.5 0.6\nv 1 1 1\n" + kFace);
  const Mesh& mesh = obj.mesh();
  EXPECT_EQ(mesh.positions, (std::vector<Vector>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1, 1, 1}}));
  EXPECT_EQ(mesh.colours, (std::vector<Vector>{{1, 1, 1}, {0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}, {1, 1, 1}}));
  EXPECT_TRUE(obj.report().warnings.empty());
}

TEST(Obj, HasNoColoursWhereNoneAreWritten) { EXPECT_TRUE(parse(kThreeVertices + kFace).mesh().colours.empty()); }

TEST(Obj, ClampsColoursWithAWarning) {
  const OBJ obj = parse("v 0 0 0 255 -1 0.5\nv 1 0 0\nv 0 1 0\n" + kFace);
  EXPECT_EQ(obj.mesh().colours[0], Vector(1, 0, 0.5f));
  EXPECT_EQ(obj.report().warnings.size(), 1u);
}

TEST(Obj, WarnsOfNumbersTooMany) {
  const OBJ obj = parse("v 0 0 0 1 2\nv 1 0 0 1 1 1 1 9\nv 0 1 0\nvn 0 0 1 5\nvt 0 0 0 0\n" + kFace);
  EXPECT_EQ(obj.report().warnings.size(), 2u);
  EXPECT_EQ(obj.mesh().normals.size(), 1u);
}

TEST(Obj, RefusesBadNumbers) {
  for (const char* word : {"x", "nan", "-inf", "1e39", "1.2.3", "0x1p3", "1,0", "1e", "--1", "1/2"}) {
    expect_refused("\nv 0 " + std::string(word) + " 0\n", Cause::BadNumber, 2);
    expect_refused("v 0 0 0 " + std::string(word) + "\n", Cause::BadNumber, 1);
    expect_refused("#\n#\nvn 0 0 " + std::string(word), Cause::BadNumber, 3);
    expect_refused("vt " + std::string(word) + "\n", Cause::BadNumber, 1);
  }
}

TEST(Obj, RefusesStatementsCutShort) {
  for (const char* text :
       {"v\n", "v 1\n", "v 1 2\n", "v 1 2", "v 1 2 # 3\n", "vn 1 2\n", "vt\n", "vn", "f\n", "f 1\n", "f 1 2\n"}) {
    expect_refused(kThreeVertices + text, Cause::TruncatedStatement, 4);
  }
}

TEST(Obj, TextureCoordinatesHaveOneToThreeNumbers) {
  const OBJ obj = parse("vt 0.5\nvt 0.25 0.75\nvt 1 2 3\n" + kThreeVertices + "f 1/1 2/2 3/3\n");
  EXPECT_EQ(obj.mesh().texture_coordinates, (std::vector<glm::vec2>{{0.5f, 0}, {0.25f, 0.75f}, {1, 2}}));
}

// Faces.

TEST(Obj, ReadsAllIndexForms) {
  const std::string head = kThreeVertices + "vt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 0 2\n";
  const Mesh mesh =
      parse(head + "f 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//2 3//1\nf 1/1/1 2/2/2 3/1/1\nf 1 2/2 3//1\nf 1/ 2// 3/1/\n")
          .mesh();
  constexpr std::uint32_t kNo = kNoIndex;
  EXPECT_EQ(mesh.triangles, std::vector<Corners>(6, {0, 1, 2}));
  EXPECT_EQ(
      mesh.texture_corners,
      (std::vector<Corners>{{kNo, kNo, kNo}, {0, 1, 0}, {kNo, kNo, kNo}, {0, 1, 0}, {kNo, 1, kNo}, {kNo, kNo, 0}}));
  EXPECT_EQ(
      mesh.normal_corners,
      (std::vector<Corners>{{kNo, kNo, kNo}, {kNo, kNo, kNo}, {0, 1, 0}, {0, 1, 0}, {kNo, kNo, 0}, {kNo, kNo, kNo}}));
}

TEST(Obj, LeavesArraysEmptyThatSayNothing) {
  const Mesh mesh = parse("vt 0 0\nvn 0 0 1\n" + kThreeVertices + kFace).mesh();
  EXPECT_TRUE(mesh.normal_corners.empty());
  EXPECT_TRUE(mesh.texture_corners.empty());
  EXPECT_TRUE(mesh.polygons.empty());
  EXPECT_TRUE(mesh.triangle_materials.empty());
}

TEST(Obj, NegativeIndicesCountBackFromWhatWasRead) {
  const Mesh mesh =
      parse(kThreeVertices + "vt 0 0\nvn 0 0 1\nf -3/-1/-1 -2/-1/-1 -1/-1/-1\nv 5 5 5\nf -4 -3 -1\n").mesh();
  EXPECT_EQ(mesh.triangles, (std::vector<Corners>{{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(mesh.normal_corners[0], (Corners{0, 0, 0}));
}

TEST(Obj, PositiveIndicesMayPointForward) {
  const Mesh mesh = parse("f 1/1 2/1 3/1 4/1\nf 1 2 3\n" + kFourVertices + "vt 0 0\n").mesh();
  EXPECT_EQ(mesh.triangles, (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
}

TEST(Obj, PolygonsAheadOfTheirVerticesAreCutAsOthers) {
  const std::string arrow = "v 0 0 0\nv 4 4 0\nv 0 2 0\nv -4 4 0\nvt 0 0\nvt 1 1\nvt 2 2\nvt 3 3\n";
  const std::string faces = "f 2/2 3/3 4/4 1/1\nf 1/1 2/2 3/3\n";
  const Mesh before = parse(faces + arrow).mesh(), after = parse(arrow + faces).mesh();
  EXPECT_EQ(before.triangles, after.triangles);
  EXPECT_EQ(before.texture_corners, after.texture_corners);
  EXPECT_NE(before.triangles[0], (Corners{1, 2, 3}));  // the fan would be wrong
}

TEST(Obj, RefusesIndicesOutOfRange) {
  expect_refused(kThreeVertices + "f 1 2 0\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "f 1 2 -4\nv 0 0 0\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "f 1 2 4\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "f 1 2 -0\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "f 1/1 2/1 3/1\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "vt 0 0\nf 1/1 2/-2 3/1\n", Cause::BadIndex, 5);
  expect_refused(kThreeVertices + "f 1//1 2//1 3//1\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "f 1 2 99999999999999999999\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "f 1 2 -99999999999999999999\n", Cause::BadIndex, 4);
  expect_refused(kThreeVertices + "f 1 2 4294967297\n", Cause::BadIndex, 4);  // 1, if it were cut to 32 bits
}

TEST(Obj, NamesTheFirstLineThatPointsPastTheEnd) {
  expect_refused("f 1 2 3\nf 1 2 5\nf 1 2 6\n" + kFourVertices, Cause::BadIndex, 2);
  expect_refused("f 1 2 4\nf 1 2 9\nf 1 2 5\n" + kFourVertices, Cause::BadIndex, 2);
}

TEST(Obj, RefusesWhatIsNoIndex) {
  for (const char* corner : {"x", "1.5", "1/x", "1/1/x", "/1", "1/1/1/1", "1\\2", "1,2", "-", "1/-"}) {
    expect_refused(kThreeVertices + "vt 0 0\nvn 0 0 1\nf 1 2 " + corner + "\n", Cause::BadNumber, 6);
  }
}

TEST(Obj, PolygonsKeepTheirNumber) {
  const OBJ obj = parse(kFourVertices + "f 1 2 3\nf 1 2 3 4\nf 2 3 4\n");
  EXPECT_EQ(obj.mesh().polygons, (std::vector<std::uint32_t>{0, 1, 1, 2}));
  EXPECT_EQ(obj.report().polygons, 3);
  EXPECT_EQ(obj.report().triangles, 4);
}

TEST(Obj, SelfIntersectingPolygonsAreFansWithAWarning) {
  const OBJ obj = parse(kFourVertices + "f 1 2 4 3\nf 1 2 3\nf 1 2 4 3\n");
  EXPECT_EQ(obj.mesh().triangles[0], (Corners{0, 1, 3}));
  EXPECT_EQ(obj.report().self_intersecting_polygons, 2);
  ASSERT_EQ(obj.report().warnings.size(), 1u);
  EXPECT_EQ(obj.report().warnings[0].rfind("test.obj:5: ", 0), 0u);
}

// Lines.

TEST(Obj, ReadsCrlfContinuationsCommentsTabsAndALastLineWithoutNewline) {
  const OBJ obj =
      parse("\xEF\xBB\xBF# head\r\n\tv 0 0 0\r\n  v 1\t0  0 # a comment\r\n\r\nv 0 1 0\r\nf 1 \\\r\n2 \\\n3");
  EXPECT_EQ(obj.mesh().positions.size(), 3u);
  EXPECT_EQ(obj.mesh().triangles, std::vector<Corners>(1, {0, 1, 2}));
}

TEST(Obj, LinesAreCountedThroughContinuations) {
  expect_refused("v 0 \\\n0 \\\n0\nv x 0 0\n", Cause::BadNumber, 4);
  expect_refused("v 0 0 0\nv 0 \\\n0 \\\nx\n", Cause::BadNumber, 2);
}

TEST(Obj, IgnoredStatementsAreCountedOnceEach) {
  const OBJ obj = parse(kThreeVertices + "l 1 2\np 1\nl 2 3\ncstype bezier\nxyz\n" + kFace + "v\xC3\xA9 1\n");
  const auto& ignored = obj.report().ignored;
  ASSERT_EQ(ignored.size(), 5u);
  EXPECT_EQ(ignored[0].statement, "l");
  EXPECT_EQ(ignored[0].count, 2);
  EXPECT_EQ(ignored[0].first_line, 4);
  EXPECT_EQ(ignored[3].statement, "xyz");
  EXPECT_EQ(ignored[4].statement, "v\xC3\xA9");
}

TEST(Obj, ManyUnknownStatementsShareOneEntry) {
  std::string text = kThreeVertices + kFace;
  for (int i = 0; i < 1000; ++i) text += "unknown" + std::to_string(i) + "\n";
  const auto ignored = parse(text).report().ignored;
  EXPECT_EQ(ignored.size(), 64u);
  EXPECT_EQ(ignored.back().count, 1000 - 63);
}

TEST(Obj, RefusesWhatIsNoText) {
  expect_refused(std::string("\xFE\xFF\0v", 4), Cause::BadEncoding, 0);
  expect_refused(std::string("\xFF\xFEv\0", 4), Cause::BadEncoding, 0);
  expect_refused(std::string("v 0 0 0\nv\0 0 0 0\n", 17), Cause::BadEncoding, 2);
  expect_refused("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", Cause::BadEncoding, 0);
}

TEST(Obj, RefusesFilesWithoutFaces) {
  expect_refused("", Cause::NoFaces, 0);
  expect_refused("\n", Cause::NoFaces, 0);
  expect_refused(kThreeVertices, Cause::NoFaces, 0);
}

TEST(Obj, KeepsItsLimits) {
  OBJ::Limits limits;
  limits.max_faces = 3;
  const std::string text = kFourVertices + "f 1 2 3\nf 1 2 3 4\n";
  EXPECT_EQ(parse(text, limits).mesh().face_count(), 3u);
  expect_refused(text + "f 1 2 3\n", Cause::TooLarge, 7, limits);
  limits.max_faces = 2;
  expect_refused(text, Cause::TooLarge, 6, limits);
  limits.max_faces = 3;
  limits.max_bytes = text.size();
  EXPECT_NO_THROW(parse(text, limits));
  limits.max_bytes = text.size() - 1;
  expect_refused(text, Cause::TooLarge, 0, limits);
}

// Groups and materials.

TEST(Obj, CountsObjectsAndGroups) {
  const OBJ obj = parse("o a\ng b c\ng\no d\n" + kThreeVertices + kFace);
  EXPECT_EQ(obj.report().objects, 2);
  EXPECT_EQ(obj.report().groups, 2);
  EXPECT_TRUE(obj.report().ignored.empty());
}

TEST(Obj, SmoothsWithinGroupsWhereNormalsAreMissing) {
  const std::string sheet = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  EXPECT_TRUE(parse(sheet + "f 1 2 3\nf 1 3 4\n").mesh().normal_corners.empty());
  EXPECT_TRUE(parse(sheet + "s off\nf 1 2 3\ns 0\nf 1 3 4\n").mesh().normal_corners.empty());
  const Mesh smooth = parse(sheet + "s 1\nf 1 2 3\nf 1 3 4\n").mesh();
  ASSERT_EQ(smooth.normal_corners.size(), 2u);
  EXPECT_EQ(smooth.normal_corners[0][0], smooth.normal_corners[1][0]);
  EXPECT_GT(smooth.normals[smooth.normal_corners[0][0]].x, 0.1f);
  const Mesh apart = parse(sheet + "s 1\nf 1 2 3\ns 2\nf 1 3 4\n").mesh();
  EXPECT_NE(apart.normal_corners[0][0], apart.normal_corners[1][0]);
  const Mesh given = parse(sheet + "vn 0 0 3\ns 1\nf 1//1 2//1 3\nf 1 3 4\n").mesh();
  EXPECT_EQ(given.normal_corners[0][0], 0u);
  EXPECT_GE(given.normal_corners[0][2], 1u);
  EXPECT_EQ(parse(sheet + "vn 0 0 3\ns 1\nf 1//1 2//1 3\n").report().normals, 1);
}

TEST(Obj, OddSmoothingGroupsAreOffWithAWarning) {
  for (const char* group : {"on", "-1", "1.5", "1 2", "99999999999"}) {
    const OBJ obj = parse(kThreeVertices + "s " + group + "\n" + kFace);
    EXPECT_TRUE(obj.mesh().normal_corners.empty()) << group;
    EXPECT_EQ(obj.report().warnings.size(), 1u) << group;
  }
  EXPECT_TRUE(parse(kThreeVertices + "s\n" + kFace).report().warnings.empty());
}

/// A folder of files, gone at the end of the test.
class ObjFolder : public testing::Test {
 protected:
  ObjFolder() : folder_(std::filesystem::path(testing::TempDir()) / "facemap_obj_test") {
    std::filesystem::create_directories(folder_ / "sub folder");
  }
  ~ObjFolder() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

TEST_F(ObjFolder, ReadsMaterialsOfSeveralFilesInEitherOrder) {
  write("a.mtl", "newmtl red\nKd 1 0 0\n");
  write("sub folder/my b.mtl", "newmtl dark green\nKd 0 .5 0\nnewmtl red\nKd .9 0 0\n");
  const OBJ obj = OBJ::load(
      write("m.obj", kThreeVertices + "f 1 2 3\nusemtl dark green\nf 1 2 3\nusemtl red\nf 2 3 1\nusemtl\nf 3 1 2\n" +
                         "mtllib a.mtl sub folder/my b.mtl\n"));
  ASSERT_EQ(obj.materials().size(), 3u);
  EXPECT_EQ(obj.mesh().triangle_materials, (std::vector<std::uint32_t>{kNoIndex, 1, 0, kNoIndex}));
  EXPECT_TRUE(obj.report().warnings.empty());
}

TEST_F(ObjFolder, AbsentFilesAndMaterialsAreWarnings) {
  const OBJ obj = OBJ::load(write("m.obj", "mtllib no.mtl nor this.mtl\n" + kThreeVertices + "usemtl x\n" + kFace));
  EXPECT_TRUE(obj.mesh().triangle_materials.empty());
  EXPECT_EQ(obj.report().warnings.size(), 2u);
}

TEST_F(ObjFolder, BrokenMtlFilesAreWarnings) {
  write("nul.mtl", std::string("newmtl a\0", 9));
  write("bad.mtl", "newmtl a\nKd x\n");
  const OBJ obj = OBJ::load(write("m.obj", "mtllib nul.mtl bad.mtl m.obj\n" + kThreeVertices + "usemtl a\n" + kFace));
  EXPECT_EQ(obj.mesh().triangle_materials, std::vector<std::uint32_t>{0});
  EXPECT_EQ(obj.report().warnings.size(), 3u);  // m.obj is no MTL file either
}

TEST_F(ObjFolder, OpensNoMtlFileOutsideItsFolder) {
  write("outside.mtl", "newmtl a\n");
  const std::string text = "usemtl a\n" + kThreeVertices + kFace;
  for (const std::string& name :
       {std::string("../outside.mtl"), (folder_ / "outside.mtl").string(), std::string("C:\\x\\outside.mtl")}) {
    const OBJ away = OBJ::load(write("sub folder/m.obj", "mtllib " + name + "\n" + text));
    EXPECT_TRUE(away.materials().empty()) << name;
    EXPECT_EQ(away.report().warnings.size(), 2u) << name;
    const OBJ beside = OBJ::load(write("m.obj", "mtllib " + name + "\n" + text));
    EXPECT_EQ(beside.materials().size(), 1u) << name;
  }
}

TEST_F(ObjFolder, FilesOfAllSizesAroundAPageAreRead) {
  for (std::size_t size = 4090; size < 4100; ++size) {
    std::string text = kThreeVertices + "#";
    text += std::string(size - text.size() - 8, 'x') + "\nf 1 2 3";
    ASSERT_EQ(text.size(), size);
    EXPECT_EQ(OBJ::load(write("page.obj", text)).mesh().face_count(), 1u);
    EXPECT_EQ(OBJ::load(write("page.obj", text + "\n")).mesh().face_count(), 1u);
  }
}

TEST_F(ObjFolder, FileLimitsAreKept) {
  const std::filesystem::path path = write("m.obj", kThreeVertices + kFace);
  OBJ::Limits limits;
  limits.max_bytes = 10;
  try {
    OBJ::load(path, limits);
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_EQ(error.cause(), Cause::TooLarge);
  }
}

TEST(Obj, FacesHaveVerticesAndNormals) {
  const std::vector<Face> faces = parse(kThreeVertices + "vn 0 0 1\nf 1//1 2 3//1\n").faces();
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].vertices[1], Vector(1, 0, 0));
  EXPECT_EQ(faces[0].normals[0], Vector(0, 0, 1));
  EXPECT_EQ(faces[0].normals[1], Vector(0));
}

}  // namespace
}  // namespace facemap
