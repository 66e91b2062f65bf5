#include "scene/mtl.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/obj_materials.h"

namespace facemap {
namespace {

struct Parsed {
  std::vector<Material> materials;
  std::vector<std::string> warnings;
};

Parsed parse(const std::string& text) {
  Parsed parsed;
  ObjWarnings warnings("test.mtl");
  parse_mtl(text, warnings, parsed.materials);
  warnings.append_to(parsed.warnings);
  return parsed;
}

std::string texture_of(const std::string& statement, const std::string& keyword) {
  const Parsed parsed = parse("newmtl a\n" + statement + "\n");
  return parsed.materials.at(0).textures.at(keyword);
}

TEST(Mtl, ReadsAllNumbers) {
  const Parsed parsed = parse(
      "# comment\nnewmtl red paint\n\tKa 0.1 .2 3e-1\n  Kd 1 0 0\nKs 0.5\nKe 0 0 2\nNs 10\r\nNi 1.5\nd 0.25\nillum "
      "3\n");
  ASSERT_EQ(parsed.materials.size(), 1u);
  const Material& material = parsed.materials[0];
  EXPECT_EQ(material.name, "red paint");
  EXPECT_EQ(material.ambient, Vector(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(material.diffuse, Vector(1, 0, 0));
  EXPECT_EQ(material.specular, Vector(0.5f));
  EXPECT_EQ(material.emission, Vector(0, 0, 2));
  EXPECT_EQ(material.shininess, 10);
  EXPECT_EQ(material.optical_density, 1.5f);
  EXPECT_EQ(material.opacity, 0.25f);
  EXPECT_EQ(material.illumination, 3);
  EXPECT_TRUE(parsed.warnings.empty());
}

TEST(Mtl, OpacityIsDBeforeTr) {
  EXPECT_EQ(parse("newmtl a\nTr 0.25\n").materials[0].opacity, 0.75f);
  EXPECT_EQ(parse("newmtl a\nTr 0.25\nd 0.5\n").materials[0].opacity, 0.5f);
  EXPECT_EQ(parse("newmtl a\nd 0.5\nTr 0.25\n").materials[0].opacity, 0.5f);
  EXPECT_EQ(parse("newmtl a\nd 0.5\nnewmtl b\nTr 0.25\n").materials[1].opacity, 0.75f);
  EXPECT_EQ(parse("newmtl a\nd -halo 0.5\n").materials[0].opacity, 0.5f);
}

TEST(Mtl, KeepsDefaultsWithAWarningWhereNumbersAreBad) {
  const Parsed parsed = parse("newmtl a\nKd 1 nan 0\nKd spectral file.rfl 1\nNs\nKs 1 2\nillum 1e30\n");
  EXPECT_EQ(parsed.materials[0].diffuse, Material().diffuse);
  EXPECT_EQ(parsed.materials[0].specular, Material().specular);
  EXPECT_EQ(parsed.materials[0].shininess, Material().shininess);
  EXPECT_EQ(parsed.materials[0].illumination, 10);
  ASSERT_EQ(parsed.warnings.size(), 1u);
  EXPECT_EQ(parsed.warnings[0], "test.mtl:2: not a number: nan (4 times)");
}

TEST(Mtl, WarnsOfStatementsBeforeAnyMaterial) {
  const Parsed parsed = parse("Kd 1 1 1\n");
  EXPECT_TRUE(parsed.materials.empty());
  EXPECT_EQ(parsed.warnings.size(), 1u);
}

TEST(Mtl, TextureNamesStandBehindOptions) {
  EXPECT_EQ(texture_of("map_Kd a.png", "map_Kd"), "a.png");
  EXPECT_EQ(texture_of("map_Kd -s 1 1 1 -o 0.5 -blendu on my file.png ", "map_Kd"), "my file.png");
  EXPECT_EQ(texture_of("bump -bm 0.5 -imfchan r b.png", "bump"), "b.png");
  EXPECT_EQ(texture_of("refl -type sphere -mm 0 1 c.png", "refl"), "c.png");
  EXPECT_EQ(texture_of("map_d -colorspace linear -texres 512 d.png", "map_d"), "d.png");
  EXPECT_EQ(texture_of("map_Ka -unknown.png", "map_Ka"), "-unknown.png");
  EXPECT_EQ(texture_of("map_Ka -s", "map_Ka"), "");
}

TEST(Mtl, SplitsLibraryNames) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(split_library_names("a.mtl"), Names{"a.mtl"});
  EXPECT_EQ(split_library_names("a.mtl  b.MTL"), (Names{"a.mtl", "b.MTL"}));
  EXPECT_EQ(split_library_names("my file.mtl other one.mtl"), (Names{"my file.mtl", "other one.mtl"}));
  EXPECT_EQ(split_library_names("my\\ file.mtl"), Names{"my file.mtl"});
  EXPECT_EQ(split_library_names("folder\\a.mtl"), Names{"folder/a.mtl"});
  EXPECT_EQ(split_library_names("a.mat b.mat"), (Names{"a.mat", "b.mat"}));
  EXPECT_EQ(split_library_names(""), Names{});
}

}  // namespace
}  // namespace facemap
