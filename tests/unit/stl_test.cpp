#include "scene/stl.h"

#include <facemap/color.h>
#include <facemap/error.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace facemap {
namespace {

using Cause = LoadError::Cause;

Model read(const std::string& bytes, const ModelLimits& limits = {}) { return read_stl(bytes, "a.stl", limits); }

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + "\n";
  return all;
}

void expect_refusal(const std::string& bytes, Cause cause, std::int64_t line, const ModelLimits& limits = {}) {
  try {
    read(bytes, limits);
    ADD_FAILURE() << "was read: " << bytes;
  } catch (const LoadError& error) {
    EXPECT_EQ(error.cause(), cause) << error.what();
    EXPECT_EQ(error.line(), line) << error.what();
  }
}

/// Two triangles of a unit square with their normals.
const std::string kFirst =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";
const std::string kSecond =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex -0 1 0\nendloop\nendfacet\n";
const std::vector<Vector> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Corners> kTriangles = {{0, 1, 2}, {0, 2, 3}};

template <class Value>
void append(std::string& bytes, Value value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// The same square as a binary file, with these attributes.
std::string binary(std::string head, std::uint32_t count, std::uint16_t first = 0, std::uint16_t second = 0,
                   float odd = 0) {
  head.resize(80, '\0');
  append(head, count);
  for (const Corners& corners : kTriangles) {
    for (const float x : {0.0f, 0.0f, 1.0f}) append(head, x);
    for (const std::uint32_t corner : corners) {
      append(head, kSquare[corner].x);
      append(head, kSquare[corner].y);
      append(head, odd);
    }
    append(head, corners == kTriangles[0] ? first : second);
  }
  return head;
}

TEST(Stl, WeldsVerticesOfATextAndCountsMinusZeroAsZero) {
  const Model model = read("solid square\n" + kFirst + kSecond + "endsolid square\n");
  EXPECT_EQ(model.mesh.positions, kSquare);
  EXPECT_EQ(model.mesh.triangles, kTriangles);
  EXPECT_EQ(model.objects, std::vector<std::string>{"square"});
  EXPECT_EQ(model.triangle_objects, (std::vector<std::uint32_t>{0, 0}));
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_TRUE(model.mesh.normals.empty());
}

TEST(Stl, ReadsWhatProgramsWrite) {
  EXPECT_EQ(read("SOLID\n" + kFirst).mesh.triangles.size(), 1u);  // no endsolid
  EXPECT_EQ(read("\xEF\xBB\xBF  solid a\n" + kFirst).mesh.triangles.size(), 1u);
  const Model spread = read(
      "Solid  two words \r\n\tFACET NORMAL nan -nan(ind) 1.#INF Outer Loop\r\nVERTEX 0 0\n\n0 vertex 1.0E+0 0 0 vertex "
      "10e-1 1 0\nEndLoop EndFacet\r\nfacet outer loop vertex 0 0 0 vertex 1 1 0 vertex 0 1 0 endloop endfacet\n"
      "endsolid two words vertex 1\ncolor 1 0 0\n");
  EXPECT_EQ(spread.mesh.triangles, kTriangles);
  EXPECT_EQ(spread.objects, std::vector<std::string>{"two words"});
  EXPECT_EQ(joined(spread.warnings), "a.stl:9: unknown statement, ignored: color\n");
}

TEST(Stl, SolidsAreObjects) {
  const Model model =
      read("solid one\n" + kFirst + "endsolid\nsolid empty\nendsolid\nsolid\n" + kSecond + "endsolid\n");
  EXPECT_EQ(model.objects, (std::vector<std::string>{"one", "empty", ""}));
  EXPECT_EQ(model.triangle_objects, (std::vector<std::uint32_t>{0, 2}));
}

TEST(Stl, RefusesTextWithTheLine) {
  expect_refusal("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", Cause::TruncatedStatement, 5);
  expect_refusal("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\n", Cause::TruncatedStatement,
                 6);
  expect_refusal("solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\n", Cause::TruncatedStatement, 4);
  expect_refusal("solid\nfacet\nvertex 0 0 0\nvertex 1 0", Cause::TruncatedStatement, 4);
  expect_refusal("solid\nfacet\nfacet\n", Cause::TruncatedStatement, 3);
  expect_refusal("solid\nfacet\nsolid\n", Cause::TruncatedStatement, 3);
  expect_refusal("solid\nvertex 0 0 0\n", Cause::TruncatedStatement, 2);
  expect_refusal("solid\nfacet\nvertex 0 nan 0\n", Cause::BadNumber, 3);
  expect_refusal("solid\nfacet\nvertex 0 1,5 0\n", Cause::BadNumber, 3);
  expect_refusal("solid\nfacet normal 0 0\nouter loop\n", Cause::BadNumber, 3);
  expect_refusal("solid\nendsolid\n", Cause::NoFaces, 0);
}

TEST(Stl, ReadsBinary) {
  const Model model = read(binary("head", 2));
  EXPECT_EQ(model.mesh.positions, kSquare);
  EXPECT_EQ(model.mesh.triangles, kTriangles);
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_TRUE(model.materials.empty());
  EXPECT_EQ(read(binary("solid of a program that lies", 2)).mesh.triangles, kTriangles);
}

TEST(Stl, TheSizeDecidesWhereTheCountDisagrees) {
  for (const std::uint32_t count : {0u, 1u, 3u, 0xffffffffu}) {
    const Model model = read(binary("solid", count));
    EXPECT_EQ(model.mesh.triangles.size(), 2u);
    EXPECT_EQ(model.warnings.size(), 1u);
  }
  const std::string whole = binary("head", 2);
  EXPECT_EQ(read(whole.substr(0, whole.size() - 1)).mesh.triangles.size(), 1u);
  EXPECT_EQ(read(whole + "more").mesh.triangles.size(), 2u);
  EXPECT_EQ(read(binary("head", 1) + "more").mesh.triangles.size(), 1u);
  expect_refusal(whole.substr(0, 83), Cause::TruncatedStatement, 0);
  expect_refusal(whole.substr(0, 84), Cause::NoFaces, 0);
  expect_refusal(whole.substr(0, 133), Cause::NoFaces, 0);
  expect_refusal("", Cause::TruncatedStatement, 0);
}

TEST(Stl, RefusesBinaryThatIsNotFinite) {
  expect_refusal(binary("head", 2, 0, 0, INFINITY), Cause::BadNumber, 0);
  expect_refusal(binary("head", 2, 0, 0, NAN), Cause::BadNumber, 0);
}

TEST(Stl, VisCamColoursAreMarkedAndBlueIsLowest) {
  const Model model = read(binary("head", 2, 0x8000 | 31, 0));
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].diffuse, Vector(0, 0, 1));
  EXPECT_EQ(model.mesh.triangle_materials, (std::vector<std::uint32_t>{0, kNoIndex}));
}

TEST(Stl, MagicsColoursAreUnmarkedAndRedIsLowest) {
  const std::string head = std::string("by hand COLOR=\x00\xff\x00\xff,MATERIAL=", 29);
  const Model model = read(binary(head, 2, 31, 0x8000));
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[0].diffuse, Vector(1, 0, 0));
  EXPECT_EQ(model.materials[1].diffuse, Vector(0, 1, 0));
  const Model plain = read(binary(head, 2));
  ASSERT_EQ(plain.materials.size(), 1u);
  EXPECT_EQ(plain.materials[0].diffuse, Vector(0, 1, 0));
}

TEST(Stl, AttributesThatMayBeAnythingAreIgnored) {
  const Model model = read(binary("head", 2, 0x8001, 0x2020));
  EXPECT_TRUE(model.materials.empty());
  EXPECT_TRUE(model.mesh.triangle_materials.empty());
  EXPECT_EQ(joined(model.warnings), "a.stl: attributes that are not colours of a known kind, ignored\n");
}

TEST(Stl, NormalsThatSayTheOppositeAreAWarning) {
  std::string turned = kFirst;
  turned.replace(turned.find("0 0 1"), 5, "0 0 -1");
  const Model model = read("solid\n" + turned + "endsolid\n");
  EXPECT_EQ(model.mesh.triangles, (std::vector<Corners>{{0, 1, 2}}));
  EXPECT_EQ(joined(model.warnings), "a.stl: normals say the opposite of the winding, which counts: 1 of 1 facets\n");
  EXPECT_TRUE(read("solid\n" + turned + kSecond).warnings.empty());
}

TEST(Stl, KeepsToItsLimits) {
  ModelLimits limits;
  limits.max_faces = 1;
  expect_refusal("solid\n" + kFirst + kSecond, Cause::TooLarge, 9, limits);
  expect_refusal(binary("head", 2), Cause::TooLarge, 0, limits);
  limits = {};
  limits.max_bytes = 100;
  expect_refusal(binary("head", 2), Cause::TooLarge, 0, limits);
}

}  // namespace
}  // namespace facemap
