#include "scene/model_format.h"

#include <gtest/gtest.h>

#include <string>

namespace facemap {
namespace {

std::string binary_stl(const std::string& head, unsigned char count, std::size_t facets) {
  std::string bytes = head;
  bytes.resize(80, '\0');
  bytes += std::string(1, static_cast<char>(count)) + std::string(3, '\0') + std::string(50 * facets, '\1');
  return bytes;
}

TEST(ModelFormat, IsToldByContent) {
  EXPECT_EQ(sniff_format("ply\nformat ascii 1.0\n"), ModelFormat::Ply);
  EXPECT_EQ(sniff_format("ply\r\nformat ascii 1.0\r\n"), ModelFormat::Ply);
  EXPECT_EQ(sniff_format(std::string("glTF\2\0\0\0", 8)), ModelFormat::GltfBinary);
  EXPECT_EQ(sniff_format("\xEF\xBB\xBF \n\t{\"asset\": {}}"), ModelFormat::GltfJson);
  EXPECT_EQ(sniff_format("{\"asset\": {}}"), ModelFormat::GltfJson);
  EXPECT_EQ(sniff_format("solid name\nfacet"), ModelFormat::StlText);
  EXPECT_EQ(sniff_format("\n  SOLID\tname\r\nfacet"), ModelFormat::StlText);
  EXPECT_EQ(sniff_format(binary_stl("solid", 2, 2)), ModelFormat::StlBinary);
  EXPECT_EQ(sniff_format(binary_stl("anything", 0, 0)), ModelFormat::StlBinary);
  EXPECT_EQ(sniff_format("# a comment\n\n  v 0 0 0\n"), ModelFormat::Obj);
  EXPECT_EQ(sniff_format("mtllib a.mtl\r\n"), ModelFormat::Obj);
  EXPECT_EQ(sniff_format("g\nv 1 2 3"), ModelFormat::Obj);
}

TEST(ModelFormat, TheExtensionDecidesWhereTheContentDoesNot) {
  EXPECT_EQ(sniff_format("no statement", ".OBJ"), ModelFormat::Obj);
  EXPECT_EQ(sniff_format("", ".obj"), ModelFormat::Obj);
  EXPECT_EQ(sniff_format("solid v\nv 0 0 0\n", ".obj"), ModelFormat::Obj);
  EXPECT_EQ(sniff_format("ply\n", ".obj"), ModelFormat::Ply);
  EXPECT_EQ(sniff_format(binary_stl("head", 2, 1), ".stl"), ModelFormat::StlBinary);
  EXPECT_EQ(sniff_format(binary_stl("head", 2, 1)), ModelFormat::Unknown);
  EXPECT_EQ(sniff_format("broken", ".gltf"), ModelFormat::GltfJson);
  EXPECT_EQ(sniff_format("{\"asset\": {}}", ".obj"), ModelFormat::GltfJson) << "no OBJ file begins so";
  EXPECT_EQ(sniff_format("v 0 0 0\nv 1 0 0\n", ".stl"), ModelFormat::Obj) << "a text is no binary file";
  EXPECT_EQ(sniff_format(binary_stl("v", 2, 1), ".stl"), ModelFormat::StlBinary);
  EXPECT_EQ(sniff_format("broken", ".glb"), ModelFormat::GltfBinary);
  EXPECT_EQ(sniff_format("broken", ".ply"), ModelFormat::Ply);
}

TEST(ModelFormat, OtherThingsAreUnknown) {
  for (const char* text : {"", "\n\n", "# only a comment", "Kaydara FBX Binary", "plyable", "solidarity", "<xml/>"}) {
    EXPECT_EQ(sniff_format(text), ModelFormat::Unknown) << text;
    EXPECT_EQ(sniff_format(text, ".fbx"), ModelFormat::Unknown) << text;
  }
}

}  // namespace
}  // namespace facemap
