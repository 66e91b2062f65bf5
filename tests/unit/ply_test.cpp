#include "scene/ply.h"

#include <facemap/color.h>
#include <facemap/error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace facemap {
namespace {

using Cause = LoadError::Cause;

Model read(const std::string& text, const ModelLimits& limits = {}) { return read_ply(text, "a.ply", "", limits); }

struct Refusal {
  Cause cause = Cause::CannotOpen;
  std::int64_t line = -1;
  std::string reason;
};

Refusal refusal(const std::string& text, const ModelLimits& limits = {}) {
  try {
    read(text, limits);
  } catch (const LoadError& error) {
    EXPECT_EQ(error.file(), "a.ply");
    return {error.cause(), error.line(), error.reason()};
  }
  ADD_FAILURE() << "was read: " << text;
  return {};
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + "\n";
  return all;
}

/// A head for three vertices and one face.
const std::string kTriangleHead =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kTriangle = kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// Appends numbers to the body of a binary file.
class Bytes {
 public:
  explicit Bytes(bool is_big_endian) : is_big_endian_(is_big_endian) {}

  template <class Value>
  Bytes& add(Value value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (is_big_endian_) std::reverse(bytes, bytes + sizeof value);
    text.append(bytes, sizeof value);
    return *this;
  }

  std::string text;

 private:
  bool is_big_endian_;
};

TEST(Ply, ReadsATriangle) {
  const Model model = read(kTriangle);
  EXPECT_EQ(model.mesh.positions, (std::vector<Vector>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(model.mesh.triangles, (std::vector<Corners>{{0, 1, 2}}));
  EXPECT_TRUE(model.mesh.normals.empty());
  EXPECT_TRUE(model.mesh.colours.empty());
  EXPECT_TRUE(model.mesh.polygons.empty());
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_FALSE(model.up.has_value());
}

TEST(Ply, LinesMayEndInCarriageReturnsAndBlanks) {
  std::string text;
  for (const char c : kTriangle) text += c == '\n' ? std::string(" \t\r\n") : std::string(1, c);
  EXPECT_EQ(read(text).mesh.triangles.size(), 1u);
  EXPECT_EQ(read(kTriangle.substr(0, kTriangle.size() - 1)).mesh.triangles.size(), 1u);
  EXPECT_EQ(read(kTriangleHead + "\n0 0 0\n\n1 0 0\n 0 1 0\n\n3 0 1 2").mesh.triangles.size(), 1u);
}

TEST(Ply, BinaryOfBothOrdersIsTheSame) {
  for (const bool is_big : {false, true}) {
    Bytes body(is_big);
    for (int i = 0; i < 3; ++i) {
      body.add(std::uint8_t(7)).add(std::uint8_t(1)).add(double(9));          // a list that nobody knows
      body.add(double(i == 1) / 3).add(std::int16_t(-5)).add(float(i == 2));  // z, flags, x
      body.add(std::uint8_t(255)).add(std::uint8_t(128)).add(std::uint8_t(0)).add(std::int8_t(i));  // colour, y
    }
    body.add(std::uint32_t(3)).add(std::uint16_t(2)).add(std::uint16_t(1)).add(std::uint16_t(0)).add(float(1));
    const std::string head = std::string("ply\r\nformat binary_") + (is_big ? "big" : "little") +
                             "_endian 1.0\r\nelement vertex 3\r\nproperty uint8 kind\r\n"
                             "property list uint8 float64 odd\r\nproperty double z\r\nproperty short flags\r\n"
                             "property float32 x\r\nproperty uchar red\r\nproperty uchar green\r\n"
                             "property uchar blue\r\nproperty char y\r\nelement face 1\r\n"
                             "property list uint ushort vertex_index\r\nproperty float quality\r\nend_header\r\n";
    const Model model = read(head + body.text);
    EXPECT_EQ(model.mesh.positions, (std::vector<Vector>{{0, 0, 0}, {0, 1, static_cast<float>(1.0 / 3)}, {1, 2, 0}}));
    EXPECT_EQ(model.mesh.triangles, (std::vector<Corners>{{2, 1, 0}}));
    ASSERT_EQ(model.mesh.colours.size(), 3u);
    const Color linear = Color::from_24_bit(0xff8000);
    EXPECT_EQ(model.mesh.colours[2], Vector(linear.r, linear.g, linear.b));
  }
}

TEST(Ply, ManyRowsAreReadInBlocks) {
  constexpr std::uint32_t kCount = 10000;
  Bytes body(false);
  for (std::uint32_t i = 0; i < kCount; ++i) body.add(float(i)).add(std::uint8_t(i % 256)).add(float(i) / 2).add(0.5f);
  for (std::uint32_t i = 0; i + 2 < kCount; ++i) body.add(std::uint8_t(3)).add(i).add(i + 1).add(i + 2);
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 10000\nproperty float x\nproperty uchar skipped\n"
      "property float y\nproperty float z\nelement face 9998\nproperty list uchar uint vertex_indices\nend_header\n";
  const Mesh mesh = read(head + body.text).mesh;
  for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(mesh.positions[i], Vector(float(i), float(i) / 2, 0.5f));
  for (std::uint32_t i = 0; i + 2 < kCount; ++i) ASSERT_EQ(mesh.triangles[i], (Corners{i, i + 1, i + 2}));
}

TEST(Ply, TrianglesBetweenOtherPolygonsKeepTheirNumbers) {
  for (const bool is_big : {false, true}) {
    const std::string head = std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
                             "_endian 1.0\nelement vertex 4\nproperty char x\nproperty char y\nproperty char z\n"
                             "element face 6\nproperty short flags\nproperty list char uint vertex_indices\n"
                             "property float quality\nend_header\n";
    const std::vector<std::vector<std::uint32_t>> faces = {{0, 1, 2}, {1, 2, 3}, {0, 1, 3, 2},
                                                           {3, 2, 1}, {0, 1},    {2, 1, 0}};
    const auto text = [&](std::uint32_t odd) {
      Bytes body(is_big);
      for (const int position : {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) body.add(static_cast<std::int8_t>(position));
      for (const auto& face : faces) {
        body.add(std::int16_t(3)).add(static_cast<std::int8_t>(face.size()));
        for (const std::uint32_t corner : face) body.add(&face == &faces[3] && corner == 3 ? odd : corner);
        body.add(0.5f);
      }
      return head + body.text;
    };
    const Mesh mesh = read(text(3)).mesh;
    EXPECT_EQ(mesh.polygons, (std::vector<std::uint32_t>{0, 1, 2, 2, 3, 5}));
    ASSERT_EQ(mesh.triangles.size(), 6u);
    EXPECT_EQ(mesh.triangles[1], (Corners{1, 2, 3}));
    EXPECT_EQ(mesh.triangles[4], (Corners{3, 2, 1}));
    EXPECT_EQ(mesh.triangles[5], (Corners{2, 1, 0}));
    EXPECT_EQ(refusal(text(4)).reason, "face 3 (from 0): refers to vertex 4 (from 0) of 4");
    EXPECT_EQ(refusal(text(0xffffffffu)).reason.substr(0, 15), "face 3 (from 0)");
    const std::string whole = text(3);
    for (std::size_t size = whole.size() - 5 * 20; size < whole.size(); ++size) {
      EXPECT_EQ(refusal(whole.substr(0, size)).cause, Cause::TruncatedStatement) << size;
    }
    ModelLimits limits;
    limits.max_faces = 5;
    EXPECT_EQ(refusal(whole, limits).cause, Cause::TooLarge);
    limits.max_faces = 1;
    EXPECT_EQ(refusal(whole, limits).cause, Cause::TooLarge);
  }
}

TEST(Ply, FacesMayComeBeforeVertices) {
  const Mesh mesh = read(
                        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
                        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                        "4 0 1 2 3\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n")
                        .mesh;
  // The corner at (1, 1) is re-entrant: the fan about vertex 0 is wrong unless it has the diagonal 0-2.
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (const Corners& t : mesh.triangles) EXPECT_NE(std::find(t.begin(), t.end(), 2u), t.end());
  EXPECT_EQ(mesh.polygons, (std::vector<std::uint32_t>{0, 0}));
}

TEST(Ply, PolygonsAreCutAndShortOnesLeftOut) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n2 0 0\n2 2 0\n1 0.5 0\n0 2 0\n5 5 5\n";
  const Model model = read(head + "2 0 1\n5 0 1 2 3 4\n3 0 1 5\n0\n");
  EXPECT_EQ(model.mesh.triangles.size(), 4u);
  EXPECT_EQ(model.mesh.polygons, (std::vector<std::uint32_t>{1, 1, 1, 2}));
  EXPECT_EQ(joined(model.warnings), "a.ply:16: face of fewer than 3 corners, left out (2 times)\n");
}

TEST(Ply, VerticesHaveNormalsAndTextureCoordinates) {
  const Mesh mesh = read(
                        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float s\nproperty float t\n"
                        "property float nx\nproperty float ny\nproperty float nz\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0.25 0 0 1 0 0 0\n1 0 0 0 2 1 0 0\n0 1 nan 0 1 0 1 0\n3 0 2 1\n")
                        .mesh;
  EXPECT_EQ(mesh.normals, (std::vector<Vector>{{0, 0, 1}, {0, 0, 2}, {0, 0, 0}}));
  EXPECT_EQ(mesh.normal_corners, mesh.triangles);
  EXPECT_EQ(mesh.texture_coordinates, (std::vector<glm::vec2>{{0, 0.25f}, {1, 0}, {0, 1}}));
  EXPECT_EQ(mesh.texture_corners, mesh.triangles);
}

TEST(Ply, ColoursAreSrgbOrLinearByTheirType) {
  const auto colour = [](const std::string& type, const std::string& names, const std::string& value) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    for (const char* name : {"red", "green", "blue", "alpha"}) text += "property " + type + " " + names + name + "\n";
    text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const char* position : {"0 0 0 ", "1 0 0 ", "0 1 0 "}) text += position + value + "\n";
    return read(text + "3 0 1 2\n");
  };
  const Color half = Color::from_24_bit(0x80ff00);
  const Vector expected(half.r, half.g, half.b);
  EXPECT_EQ(colour("uchar", "", "128 255 0 255").mesh.colours.at(1), expected);
  EXPECT_EQ(colour("int", "diffuse_", "128 255 0 255").mesh.colours.at(1), expected);
  EXPECT_EQ(colour("ushort", "", "32896 65535 0 0").mesh.colours.at(2), expected);  // 128 * 257
  EXPECT_EQ(colour("float", "", "0.5 1 0 1").mesh.colours.at(0), Vector(0.5f, 1, 0));
  const Model clamped = colour("uchar", "", "300 -1 0 0");
  EXPECT_EQ(clamped.mesh.colours.at(0), Vector(1, 0, 0));
  EXPECT_EQ(joined(clamped.warnings), "a.ply:14: vertex colour outside its range, clamped (3 times)\n");
}

TEST(Ply, FacesColoursBecomeMaterials) {
  const Model model = read(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 3\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
      "1 2 3 3 0 1 2\n255 0 0 3 1 2 0\n1 2 3 3 2 1 0\n");
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[0].name, "colour 010203");
  EXPECT_EQ(model.materials[1].diffuse, Vector(1, 0, 0));
  EXPECT_EQ(model.mesh.triangle_materials, (std::vector<std::uint32_t>{0, 1, 0}));
}

TEST(Ply, StripsTurnEverySecondTriangleAndEndAtMinusOne) {
  const Mesh mesh = read(
                        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                        "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n11 0 1 2 3 3 4 -1 2 3 4 -1\n")
                        .mesh;
  EXPECT_EQ(mesh.triangles, (std::vector<Corners>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
}

TEST(Ply, TexturesAreNamedByComments) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "facemap_ply_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a b.png") << "not read";
  const std::string text =
      "ply\nformat ascii 1.0\ncomment TextureFile a b.png\ncomment TextureFile C:\\x\\missing.png\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 3\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "property int texnumber\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
      "3 0 1 2 6 0 0 1 0 0 1 1\n3 0 1 2 0 -1\n3 0 1 2 6 0 0 1 0 0.5 1 0\n";
  const Model model = read_ply(text, "a.ply", folder, {});
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].name, "a b.png");
  EXPECT_EQ(model.images[0].file.filename(), "a b.png");
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[0].diffuse_map.image, 0u);
  EXPECT_FALSE(model.materials[1].diffuse_map.is_used());
  EXPECT_EQ(joined(model.warnings), "a.ply: texture \"C:\\x\\missing.png\": there is no such file\n");
  EXPECT_EQ(model.mesh.triangle_materials, (std::vector<std::uint32_t>{1, kNoIndex, 0}));
  EXPECT_EQ(model.mesh.texture_corners, (std::vector<Corners>{{0, 1, 2}, {kNoIndex, kNoIndex, kNoIndex}, {3, 4, 5}}));
  EXPECT_EQ(model.mesh.texture_coordinates[5], glm::vec2(0.5f, 1));
  std::filesystem::remove_all(folder);
}

TEST(Ply, ATextureOutsideOfTheFolderIsNotOpened) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "facemap_ply_outside";
  std::filesystem::create_directories(folder / "model");
  std::ofstream(folder / "secret.png") << "not read";
  std::filesystem::remove(folder / "model" / "link.png");
  std::filesystem::create_symlink(folder / "secret.png", folder / "model" / "link.png");
  const std::vector<std::string> names = {"../secret.png", (folder / "secret.png").string(), "link.png"};
  for (const std::string& name : names) {
    const std::string text =
        "ply\nformat ascii 1.0\ncomment TextureFile " + name +
        "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float u\nproperty float v\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 "
        "2\n";
    const Model model = read_ply(text, "a.ply", folder / "model", {});
    EXPECT_TRUE(model.images.empty());
    EXPECT_EQ(model.warnings.size(), 1u);
  }
  std::filesystem::remove_all(folder);
}

TEST(Ply, UnknownElementsAreReadOver) {
  const Model model = read(
      "ply\nformat ascii 1.0\ncomment made by hand\nobj_info 3\nodd line\nelement camera 1\nproperty float x\n"
      "property list uchar int ids\nelement nothing 1000000000000\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement edge 2\nproperty int vertex1\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n1 2 3 4\n0 0 0\n1 0 0\n0 1 0\n1\n2\n3 0 1 2 7\n");
  EXPECT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_EQ(joined(model.warnings),
            "a.ply:5: unknown statement in the header, ignored: odd\n"
            "a.ply:25: more values than the header says, ignored\n");
}

TEST(Ply, RefusesWithTheLine) {
  const auto expect = [](const std::string& text, Cause cause, std::int64_t line) {
    const Refusal got = refusal(text);
    EXPECT_EQ(got.cause, cause) << got.reason;
    EXPECT_EQ(got.line, line) << got.reason;
  };
  expect("", Cause::TruncatedStatement, 1);
  expect("solid\n", Cause::UnknownFormat, 1);
  expect("ply\rformat ascii 1.0\r", Cause::BadEncoding, 1);
  expect("ply\nend_header\n", Cause::TruncatedStatement, 2);
  expect("ply\nformat utf 1.0\n", Cause::UnknownFormat, 2);
  expect("ply\nformat ascii 1.0\nelement vertex -1\n", Cause::BadNumber, 3);
  expect("ply\nformat ascii 1.0\nelement vertex\n", Cause::TruncatedStatement, 3);
  expect("ply\nformat ascii 1.0\nelement a 1\nproperty quad x\n", Cause::UnknownFormat, 4);
  expect("ply\nformat ascii 1.0\nelement a 1\nproperty list float int x\n", Cause::UnknownFormat, 4);
  expect("ply\nformat ascii 1.0\nproperty int x\n", Cause::UnknownFormat, 3);
  expect("ply\nformat ascii 1.0\nelement a 1\nelement a 1\n", Cause::UnknownFormat, 4);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1\n3 0 1 2\n", Cause::TruncatedStatement, 12);
  expect(kTriangleHead + "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", Cause::BadNumber, 11);
  expect(kTriangleHead + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", Cause::BadNumber, 11);
  expect(kTriangleHead + "0 0 0\n1 0 1e39\n0 1 0\n3 0 1 2\n", Cause::BadNumber, 11);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", Cause::BadIndex, 13);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", Cause::BadIndex, 13);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2.5\n", Cause::BadNumber, 13);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", Cause::BadNumber, 13);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", Cause::TruncatedStatement, 13);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n", Cause::TruncatedStatement, 12);
  expect(kTriangleHead + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", Cause::NoFaces, 0);
}

TEST(Ply, RefusesWithTheElementOfABinaryFile) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list char int vertex_indices\nend_header\n";
  const auto body = [](float odd, std::int8_t count, std::int32_t index) {
    Bytes bytes(false);
    for (int i = 0; i < 9; ++i) bytes.add(i == 5 ? odd : float(i));
    return bytes.add(count).add(0).add(1).add(index).text;
  };
  EXPECT_EQ(read(head + body(0, 3, 2)).mesh.triangles.size(), 1u);
  const Refusal infinite = refusal(head + body(INFINITY, 3, 2));
  EXPECT_EQ(infinite.cause, Cause::BadNumber);
  EXPECT_EQ(infinite.reason.substr(0, 17), "vertex 1 (from 0)");
  const Refusal outside = refusal(head + body(0, 3, 3));
  EXPECT_EQ(outside.cause, Cause::BadIndex);
  EXPECT_EQ(outside.reason, "face 0 (from 0): refers to vertex 3 (from 0) of 3");
  EXPECT_EQ(refusal(head + body(0, -1, 2)).cause, Cause::BadNumber);
  EXPECT_EQ(refusal(head + body(0, 4, 2)).reason, "the file ends after 0 of 1 rows of element \"face\"");
  const std::string whole = head + body(0, 3, 2);
  for (std::size_t size = head.size(); size < whole.size(); ++size) {
    EXPECT_EQ(refusal(whole.substr(0, size)).cause, Cause::TruncatedStatement) << size;
  }
}

TEST(Ply, PointsAloneAreNoModel) {
  const Refusal points = refusal(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "0 0 0\n");
  EXPECT_EQ(points.cause, Cause::NoFaces);
  EXPECT_EQ(points.reason, "no faces: 1 points");
}

TEST(Ply, CountsThatTheFileCannotHoldTakeNoMemory) {
  const auto text = [](const std::string& format, const std::string& vertices, const std::string& faces) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
           "\nproperty char x\nproperty char y\nproperty char z\nelement face " + faces +
           "\nproperty list uint int vertex_indices\nend_header\n0 0 0\n0 0 0\n";
  };
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    EXPECT_EQ(refusal(text(format, "4000000000", "1")).cause, Cause::TruncatedStatement);
    EXPECT_EQ(refusal(text(format, "18446744073709551615", "1")).cause, Cause::TooLarge);
    EXPECT_EQ(refusal(text(format, "18446744073709551616", "1")).cause, Cause::BadNumber);
    EXPECT_EQ(refusal(text(format, "2", "4000000000")).cause, Cause::TruncatedStatement);
  }
}

TEST(Ply, KeepsToItsLimits) {
  ModelLimits limits;
  limits.max_faces = 0;
  EXPECT_EQ(refusal(kTriangle, limits).cause, Cause::TooLarge);
  limits = {};
  limits.max_bytes = kTriangle.size() - 1;
  EXPECT_EQ(refusal(kTriangle, limits).cause, Cause::TooLarge);
  std::string many = "ply\nformat ascii 1.0\nelement a 1\n";
  for (int i = 0; i < 5000; ++i) many += "property int x\n";
  EXPECT_EQ(refusal(many).cause, Cause::TooLarge);
}

}  // namespace
}  // namespace facemap
