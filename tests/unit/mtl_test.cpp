#include "scene/mtl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/obj_materials.h"

namespace facemap {
namespace {

struct Parsed {
  std::vector<Material> materials;
  std::vector<TextureImage> images;
  std::vector<std::string> warnings;
};

// `folder`: textures are looked for in it; none: each is taken as there.
Parsed parse(const std::string& text, const std::filesystem::path& folder = {}) {
  Parsed parsed;
  ObjWarnings warnings("test.mtl");
  ImageTable images(folder, false);
  parse_mtl(text, {}, images, warnings, parsed.materials);
  parsed.images = std::move(images.images());
  warnings.append_to(parsed.warnings);
  return parsed;
}

// The one texture of a statement: how it is used, and its file.
struct OneTexture {
  TextureUse use;
  std::string name;
};

OneTexture texture_of(const std::string& statement, TextureUse Material::*which) {
  const Parsed parsed = parse("newmtl a\n" + statement + "\n");
  const TextureUse& use = parsed.materials.at(0).*which;
  return {use, use.is_used() ? parsed.images.at(use.image).file.string() : ""};
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
  const auto name = [](const std::string& rest) { return texture_of("map_Kd " + rest, &Material::diffuse_map).name; };
  EXPECT_EQ(name("a.png"), "a.png");
  EXPECT_EQ(name("-s 1 1 1 -o 0.5 -blendu on my file.png "), "my file.png");
  EXPECT_EQ(name("-type sphere -mm 0 1 c.png"), "c.png");
  EXPECT_EQ(name("-colorspace linear -texres 512 d.png"), "d.png");
  EXPECT_EQ(name("-unknown.png"), "-unknown.png");
  EXPECT_EQ(name("textures\\wood\\a b.png"), "textures/wood/a b.png");
  EXPECT_EQ(name("\"a b.png\""), "a b.png");
  EXPECT_EQ(name("-s"), "");
  EXPECT_EQ(name("-s 2 2 2 1.png"), "1.png");
}

TEST(Mtl, TextureOptionsMayFollowTheName) {
  const OneTexture texture = texture_of("map_bump -imfchan r my bumps.jpg -bm 1.5 -clamp on", &Material::bump_map);
  EXPECT_EQ(texture.name, "my bumps.jpg");
  EXPECT_EQ(texture.use.strength, 1.5f);
  EXPECT_EQ(texture.use.channel, 0);
  EXPECT_EQ(texture.use.wrap_u, TextureUse::Wrap::Clamp);
  EXPECT_EQ(texture_of("map_Kd a -s b.png", &Material::diffuse_map).name, "a -s b.png") << "no option: no number";
  EXPECT_EQ(texture_of("map_Kd a -bm 2 b.png", &Material::diffuse_map).name, "a -bm 2 b.png") << "not at the end";
}

TEST(Mtl, TextureOptionsSayHowItIsUsed) {
  const TextureUse use =
      texture_of("map_Ks -o 0.5 0.25 -s 2 3 1 -t 1 1 1 -mm 0.1 0.5 -imfchan m a.png", &Material::specular_map).use;
  EXPECT_EQ(use.offset, glm::vec2(0.5f, 0.25f));
  EXPECT_EQ(use.scale, glm::vec2(2, 3));
  EXPECT_EQ(use.base, 0.1f);
  EXPECT_EQ(use.gain, 0.5f);
  EXPECT_EQ(use.channel, 3);
  EXPECT_FALSE(use.is_v_down);
  EXPECT_EQ(use.wrap_u, TextureUse::Wrap::Repeat);
  EXPECT_EQ(texture_of("map_Kd -s 2 a.png", &Material::diffuse_map).use.scale, glm::vec2(2, 1));
  EXPECT_EQ(texture_of("map_Kd -imfchan l a.png", &Material::diffuse_map).use.channel, -1);
}

TEST(Mtl, EachMapHasItsPlaceAndEachFileIsNamedOnce) {
  const Parsed parsed = parse(
      "newmtl a\nmap_Kd 0.png\nmap_Ks 1.png\nmap_Ke 2.png\nmap_Ns 3.png\nmap_d 4.png\nmap_Pr 5.png\nmap_Pm 6.png\n"
      "map_Bump 7.png\nnorm 8.png\nnewmtl b\nmap_Kd 8.png\nbump 7.png\nmap_Kn 0.png\nmap_Ka 9.png\nrefl 9.png\n");
  ASSERT_EQ(parsed.images.size(), 9u);
  const Material &a = parsed.materials[0], &b = parsed.materials[1];
  std::uint32_t i = 0;
  for (const TextureUse* use : {&a.diffuse_map, &a.specular_map, &a.emission_map, &a.shininess_map, &a.opacity_map,
                                &a.roughness_map, &a.metallic_map, &a.bump_map, &a.normal_map}) {
    EXPECT_EQ(use->image, i++);
  }
  EXPECT_EQ(b.diffuse_map.image, 8u);
  EXPECT_EQ(b.bump_map.image, 7u);
  EXPECT_EQ(b.normal_map.image, 0u);
  EXPECT_EQ(a.alpha, Material::Alpha::Mask);
  EXPECT_EQ(b.alpha, Material::Alpha::Opaque);
}

TEST(Mtl, PrOrPmMakeAMetalRoughMaterial) {
  const Parsed parsed =
      parse("newmtl a\nPr 0.25\nPm 0.5\nnewmtl b\nmap_Pm a.png\nNs 98\nnewmtl c\nmap_Pr a.png\nnewmtl d\nNs 98\n");
  const std::vector<Material>& m = parsed.materials;
  EXPECT_EQ(m[0].kind, Material::Kind::MetalRough);
  EXPECT_EQ(m[0].roughness, 0.25f);
  EXPECT_EQ(m[0].metallic, 0.5f);
  EXPECT_EQ(m[1].kind, Material::Kind::MetalRough);
  EXPECT_EQ(m[1].metallic, 1) << "the map counts";
  EXPECT_FLOAT_EQ(m[1].roughness, std::sqrt(std::sqrt(0.02f))) << "as wide as Ns has it";
  EXPECT_EQ(m[2].metallic, 0);
  EXPECT_EQ(m[2].roughness, 1);
  EXPECT_EQ(m[3].kind, Material::Kind::Phong);
}

TEST(Mtl, ATextureShowsWhereItsFactorIsZero) {
  const Parsed parsed = parse(
      "newmtl a\nKd 0 0 0\nmap_Kd a.png\nmap_Ks a.png\nmap_Ns a.png\nnewmtl b\nKd 0 0 0\nKe 0.5 0 0\nmap_Ke a.png\n");
  EXPECT_EQ(parsed.materials[0].diffuse, Vector(1));
  EXPECT_EQ(parsed.materials[0].specular, Vector(1));
  EXPECT_EQ(parsed.materials[0].shininess, 1);
  EXPECT_EQ(parsed.materials[1].diffuse, Vector(0));
  EXPECT_EQ(parsed.materials[1].emission, Vector(0.5f, 0, 0));
}

TEST(Mtl, ATextureThatIsAbsentLeavesAWhiteSurfaceNotABlackOne) {
  const Parsed parsed = parse("newmtl a\nKd 0 0 0\nmap_Kd no-such-texture.png\nnewmtl b\nKd 0 0 0\n",
                              std::filesystem::temp_directory_path());
  EXPECT_EQ(parsed.warnings.size(), 1u);
  EXPECT_FALSE(parsed.materials[0].diffuse_map.is_used());
  EXPECT_EQ(parsed.materials[0].diffuse, Vector(1));
  EXPECT_EQ(parsed.materials[1].diffuse, Vector(0));
}

TEST(Mtl, WhereNothingWouldBeSeenAllIsOpaque) {
  const Parsed hidden = parse("newmtl a\nd 0\nnewmtl b\nTr 1\n");
  for (const Material& material : hidden.materials) {
    EXPECT_EQ(material.opacity, 1);
    EXPECT_EQ(material.alpha, Material::Alpha::Opaque);
  }
  ASSERT_EQ(hidden.warnings.size(), 1u);
  EXPECT_EQ(hidden.warnings[0], "test.mtl:2: all materials are invisible (d 0 or Tr 1); they are taken as opaque");
  const Parsed one = parse("newmtl a\nd 0\nnewmtl b\nd 0.5\n");
  EXPECT_EQ(one.materials[0].opacity, 0);
  EXPECT_EQ(one.materials[1].alpha, Material::Alpha::Blend);
  EXPECT_TRUE(one.warnings.empty());
}

TEST(Mtl, Illum0IsUnlitAndHalosAreNoted) {
  const Parsed parsed = parse("newmtl a\nillum 0\nd -halo 0.5\nnewmtl b\nillum 2\n");
  EXPECT_TRUE(parsed.materials[0].is_unlit);
  EXPECT_TRUE(parsed.materials[0].is_halo);
  EXPECT_FALSE(parsed.materials[1].is_unlit);
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
