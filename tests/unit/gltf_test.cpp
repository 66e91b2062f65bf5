// The glTF reader as a whole: containers, meshes, instances and what is refused.

#include "scene/gltf.h"

#include <facemap/error.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/gltf_text.h"

namespace facemap {
namespace {

using Cause = LoadError::Cause;

Model read(const std::string& text, const ModelLimits& limits = {}) { return read_gltf(text, "t.gltf", ".", limits); }

void expect_refused(const std::string& text, Cause cause, const std::string& part, const ModelLimits& limits = {}) {
  try {
    read(text, limits);
    ADD_FAILURE() << "was read: " << text;
  } catch (const LoadError& error) {
    EXPECT_EQ(error.cause(), cause) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).substr(0, 7), "t.gltf:");
  }
}

std::string glb(const std::string& json, const std::string& binary, std::uint32_t version = 2) {
  const auto u32 = [](std::size_t value) { return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)}); };
  std::string chunks = u32(json.size()) + "JSON" + json;
  if (!binary.empty()) chunks += u32(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + u32(version) + u32(12 + chunks.size()) + chunks;
}

const std::string kBinaryTriangle =
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":"
    "36}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],\"nodes\":[{\"mesh\":0}]"
    "," +
    kTriangleMesh + "}";
const std::string kTriangleBytes = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});

TEST(Gltf, ReadsATriangle) {
  const Model model = read(triangle_text().text(kTriangleMesh + ",\"nodes\":[{\"mesh\":0,\"name\":\"N\"}]"));
  ASSERT_EQ(model.mesh.face_count(), 1u);
  EXPECT_EQ(model.mesh.positions, (std::vector<Vector>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(model.mesh.triangles[0], (Corners{0, 1, 2}));
  EXPECT_TRUE(model.mesh.normal_corners.empty());
  EXPECT_TRUE(model.mesh.triangle_materials.empty());
  EXPECT_EQ(model.objects, std::vector<std::string>{"N"});
  EXPECT_EQ(model.up, Vector(0, 1, 0));
  EXPECT_TRUE(model.warnings.empty());
}

TEST(Gltf, ReadsTheBytesOfAGlbFile) {
  EXPECT_EQ(read(glb(kBinaryTriangle, kTriangleBytes)).mesh.face_count(), 1u);
  EXPECT_EQ(read(glb(kBinaryTriangle + "   ", kTriangleBytes + std::string(3, '\0'))).mesh.face_count(), 1u);
  EXPECT_EQ(read(glb(kBinaryTriangle, kTriangleBytes) + "more").mesh.face_count(), 1u);
}

TEST(Gltf, RefusesBrokenContainers) {
  const std::string whole = glb(kBinaryTriangle, kTriangleBytes);
  for (std::size_t size = 4; size < whole.size(); ++size) {
    EXPECT_THROW(read(whole.substr(0, size)), LoadError) << size;
  }
  expect_refused(whole.substr(0, 100), Cause::TruncatedStatement, "the header says");
  expect_refused(glb(kBinaryTriangle, kTriangleBytes, 1), Cause::Unsupported, "version 1");
  expect_refused(glb(kBinaryTriangle, ""), Cause::BadValue, "buffers[0]: has no \"uri\"");
  expect_refused(glb(kBinaryTriangle, "short"), Cause::TruncatedStatement, "buffers[0]: 36 bytes, of which 5");
  std::string odd = whole;
  odd[16] = 'X';
  expect_refused(odd, Cause::BadSyntax, "first chunk");
  std::string long_chunk = whole;
  long_chunk[15] = '\x7f';
  expect_refused(long_chunk, Cause::TruncatedStatement, "a chunk of");
}

TEST(Gltf, SaysWhereJsonIsWrong) {
  expect_refused("{\n  \"asset\": nul\n}", Cause::BadSyntax, "t.gltf:2: column 15: invalid literal");
  expect_refused("", Cause::BadSyntax, "t.gltf:1: column 1");
  expect_refused("{\"a\":1e999}", Cause::BadSyntax, "number overflow");
  expect_refused("{\"a\":\"\xff\"}", Cause::BadSyntax, "UTF-8");
  expect_refused(std::string(1 << 20, '['), Cause::TooLarge, "deep");
  expect_refused("\xff\xfe{", Cause::BadEncoding, "UTF-16");
  expect_refused("[]", Cause::BadValue, "not an object");
}

TEST(Gltf, RefusesOtherVersionsAndRequiredExtensionsByName) {
  expect_refused("{}", Cause::BadValue, "asset");
  expect_refused("{\"asset\":{\"version\":\"1.0\"}}", Cause::Unsupported, "version \"1.0\"");
  expect_refused("{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.1\"}}", Cause::Unsupported, "2.1");
  expect_refused("{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}",
                 Cause::Unsupported, "requires the extension KHR_draco_mesh_compression");
  expect_refused("{\"asset\":{\"version\":\"2.1\"}}", Cause::NoFaces, "no faces");
  const Model model = read(triangle_text().text(
      kTriangleMesh + ",\"nodes\":[{\"mesh\":0}],\"extensionsUsed\":[\"KHR_texture_transform\",\"ACME_x\"]"));
  EXPECT_EQ(model.warnings, std::vector<std::string>{"t.gltf: an extension is ignored: ACME_x"});
}

TEST(Gltf, ReadsStripsAndFans) {
  GltfText gltf;
  gltf.accessor(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}), kFloat32, "VEC3", 5);
  const auto triangles = [&](int mode) {
    return read(gltf.text("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                          "\"mode\":" +
                          std::to_string(mode) + "}]}]"))
        .mesh.triangles;
  };
  EXPECT_EQ(triangles(5), (std::vector<Corners>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(triangles(6), (std::vector<Corners>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  EXPECT_EQ(triangles(4), (std::vector<Corners>{{0, 1, 2}}));  // two corners are left over
  EXPECT_THROW(triangles(1), LoadError);                       // lines: no faces
  EXPECT_THROW(triangles(7), LoadError);
}

TEST(Gltf, KeepsOnlyTheVerticesThatAreUsed) {
  GltfText gltf;
  gltf.accessor(bytes_of<float>({9, 9, 9, 0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0}), kFloat32, "VEC3", 5);
  gltf.accessor(bytes_of<std::uint8_t>({4, 1, 3}), kUint8, "SCALAR", 3);
  const Mesh mesh = read(gltf.text("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
                                   "\"POSITION\":0},\"indices\":1}]}]"))
                        .mesh;
  EXPECT_EQ(mesh.positions, (std::vector<Vector>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles[0], (Corners{2, 0, 1}));
}

TEST(Gltf, ReadsAttributes) {
  GltfText gltf = triangle_text();
  gltf.accessor(bytes_of<float>({0, 0, 2, 0, 0, 2, 0, 0, 2}), kFloat32, "VEC3", 3);
  gltf.accessor(bytes_of<std::uint8_t>({0, 255, 51, 0, 255, 255}), kUint8, "VEC2", 3, ",\"normalized\":true");
  gltf.accessor(bytes_of<std::uint16_t>({0, 65535, 0, 65535, 0, 0, 0, 65535, 0, 0, 65535, 9}), kUint16, "VEC4", 3,
                ",\"normalized\":true");
  const std::string plain = "{\"attributes\":{\"POSITION\":0}}";
  const Model model = read(
      gltf.text("\"nodes\":[{\"mesh\":0,\"scale\":[1,1,3]}],\"meshes\":[{\"primitives\":[" + plain +
                ",{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,\"COLOR_0\":3}}," + plain + "]}]"));
  const Mesh& mesh = model.mesh;
  ASSERT_EQ(mesh.face_count(), 3u);
  const Corners none = {kNoIndex, kNoIndex, kNoIndex};
  EXPECT_EQ(mesh.normal_corners, (std::vector<Corners>{none, {0, 1, 2}, none}));
  EXPECT_EQ(mesh.texture_corners, (std::vector<Corners>{none, {0, 1, 2}, none}));
  EXPECT_EQ(mesh.normals[0], Vector(0, 0, 1));
  EXPECT_EQ(mesh.texture_coordinates[1], glm::vec2(static_cast<float>(51 / 255.0), 0));
  ASSERT_EQ(mesh.colours.size(), 9u);
  EXPECT_EQ(mesh.colours[0], Vector(1));
  EXPECT_EQ(mesh.colours[3], Vector(0, 1, 0));
  EXPECT_EQ(mesh.colours[8], Vector(1));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("alpha of vertices' colours"), std::string::npos);
}

TEST(Gltf, RefusesPositionsThatAreNotFinite) {
  GltfText gltf;
  gltf.accessor(bytes_of<float>({0, 0, 0, 1, 0, INFINITY, 0, 1, 0}), kFloat32, "VEC3", 3);
  expect_refused(gltf.text(kTriangleMesh + ",\"nodes\":[{\"mesh\":0}]"), Cause::BadNumber, "accessors[0]: position 1");
  expect_refused(triangle_text().text(kTriangleMesh + ",\"nodes\":[{\"mesh\":0,\"scale\":[1e300,1,1]}]"),
                 Cause::BadNumber, "nodes[0]: moves a vertex");
}

TEST(Gltf, RefusesAttributesAndIndicesThatDoNotFit) {
  const auto mesh = [](const std::string& primitive) {
    return "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[" + primitive + "]}]";
  };
  GltfText gltf = triangle_text();
  gltf.accessor(bytes_of<float>({0, 0, 0, 0}), kFloat32, "VEC2", 2);
  gltf.accessor(bytes_of<std::uint16_t>({0, 1, 3}), kUint16, "SCALAR", 3);
  expect_refused(gltf.text(mesh("{\"attributes\":{\"POSITION\":1}}")), Cause::BadValue, "has 2 components");
  expect_refused(gltf.text(mesh("{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1}}")), Cause::BadIndex,
                 "accessors[1] has 2 elements for 3 vertices");
  expect_refused(gltf.text(mesh("{\"attributes\":{\"POSITION\":0},\"indices\":2}")), Cause::BadIndex,
                 "accessors[2]: index 2 names vertex 3 of 3");
  expect_refused(gltf.text(mesh("{\"attributes\":{\"POSITION\":0},\"indices\":0}")), Cause::BadValue, "unsigned");
  expect_refused(gltf.text(mesh("{\"attributes\":{\"POSITION\":7}}")), Cause::BadIndex, "names accessors[7] of 3");
  expect_refused(gltf.text(mesh("{\"attributes\":{\"POSITION\":0},\"material\":0}")), Cause::BadIndex, "materials[0]");
  expect_refused(gltf.text(mesh("{}")), Cause::BadValue, "meshes[0].primitives[0]: has no \"attributes\"");
}

TEST(Gltf, CountsInstancesAgainstTheLimitOfFaces) {
  ModelLimits limits;
  limits.max_faces = 3;
  const std::string three = "{\"mesh\":0},{\"mesh\":0},{\"mesh\":0}";
  const Model model = read(triangle_text().text(kTriangleMesh + ",\"nodes\":[" + three + "]"), limits);
  EXPECT_EQ(model.mesh.face_count(), 3u);
  EXPECT_EQ(model.triangle_objects, (std::vector<std::uint32_t>{0, 1, 2}));
  expect_refused(triangle_text().text(kTriangleMesh + ",\"nodes\":[" + three + ",{\"mesh\":0}]"), Cause::TooLarge,
                 "more than 3 triangles", limits);
}

TEST(Gltf, PlacesInstancesOfAList) {
  GltfText gltf = triangle_text();
  gltf.accessor(bytes_of<float>({5, 0, 0, 0, 6, 0}), kFloat32, "VEC3", 2);
  gltf.accessor(bytes_of<float>({1, 1, 1, 2, 2, 2}), kFloat32, "VEC3", 2);
  const Model model = read(
      gltf.text(kTriangleMesh + ",\"nodes\":[{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
                                "\"TRANSLATION\":1,\"SCALE\":2}}}}]"));
  ASSERT_EQ(model.mesh.face_count(), 2u);
  EXPECT_EQ(model.mesh.positions[1], Vector(6, 0, 0));
  EXPECT_EQ(model.mesh.positions[4], Vector(2, 6, 0));
  EXPECT_EQ(model.objects.size(), 1u);
}

TEST(Gltf, LooksForFilesInItsFolderAlone) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "facemap_gltf_test";
  std::filesystem::create_directories(folder / "inner");
  std::ofstream(folder / "inner" / "a b.bin", std::ios::binary) << kTriangleBytes;
  std::ofstream(folder / "outside.bin", std::ios::binary) << kTriangleBytes;
  std::filesystem::remove(folder / "inner" / "link.bin");
  std::filesystem::create_symlink("../outside.bin", folder / "inner" / "link.bin");
  const auto read_uri = [&](const std::string& uri, const ModelLimits& limits = {}) {
    std::string text = kBinaryTriangle;
    text.insert(text.find("{\"byteLength\":36}") + 1, "\"uri\":\"" + uri + "\",");
    return read_gltf(text, "t.gltf", folder / "inner", limits);
  };
  const auto cause_of = [&](const std::string& uri, const ModelLimits& limits = {}) {
    try {
      read_uri(uri, limits);
    } catch (const LoadError& error) {
      return error.cause();
    }
    return Cause::NoFaces;
  };
  EXPECT_EQ(read_uri("a b.bin").mesh.face_count(), 1u);
  EXPECT_EQ(read_uri("a%20b.bin").mesh.face_count(), 1u);
  EXPECT_EQ(read_uri("./x/../a%20b.bin").mesh.face_count(), 1u);
  EXPECT_EQ(cause_of("../outside.bin"), Cause::NotAllowed);
  EXPECT_EQ(cause_of("%2e%2e/outside.bin"), Cause::NotAllowed);
  EXPECT_EQ(cause_of("link.bin"), Cause::NotAllowed);
  EXPECT_EQ(cause_of("/etc/passwd"), Cause::NotAllowed);
  EXPECT_EQ(cause_of("http://example.org/a.bin"), Cause::NotAllowed);
  EXPECT_EQ(cause_of("file:///etc/passwd"), Cause::NotAllowed);
  EXPECT_EQ(cause_of("none.bin"), Cause::CannotOpen);
  EXPECT_EQ(cause_of("."), Cause::CannotOpen);
  ModelLimits limits;
  limits.max_bytes = 1000;
  EXPECT_EQ(read_uri("a b.bin", limits).mesh.face_count(), 1u);
  std::filesystem::resize_file(folder / "inner" / "a b.bin", 900);
  EXPECT_EQ(cause_of("a b.bin", limits), Cause::TooLarge);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace facemap
