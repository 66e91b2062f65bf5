#include "scene/gltf_materials.h"

#include <gtest/gtest.h>

#include <string>

#include "scene/gltf.h"
#include "support/gltf_text.h"

namespace facemap {
namespace {

const std::string kPng = "\x89PNG\r\n\x1a\n and so on";

/// A triangle of the first of these materials; two textures of an embedded image, and what `textures` adds.
Model read(const std::string& materials, const std::string& more_textures = "", const std::string& more_images = "") {
  GltfText gltf = triangle_text();
  const int view = gltf.view(kPng);
  return read_gltf(
      gltf.text(
          "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
          "\"images\":[{\"bufferView\":" +
          std::to_string(view) + ",\"mimeType\":\"image/png\"}" + more_images +
          "],\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648,\"magFilter\":9728}],"
          "\"textures\":[{\"source\":0},{\"source\":0,\"sampler\":0}" +
          more_textures + "],\"materials\":[" + materials + "]"),
      "t.gltf", ".");
}

TEST(GltfMaterials, AreMetalAndRoughByDefault) {
  const Model model = read("{\"name\":\"plain\"}");
  ASSERT_EQ(model.materials.size(), 1u);
  const Material& material = model.materials[0];
  EXPECT_EQ(material.name, "plain");
  EXPECT_EQ(material.kind, Material::Kind::MetalRough);
  EXPECT_EQ(material.diffuse, Vector(1));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 1);
  EXPECT_EQ(material.emission, Vector(0));
  EXPECT_EQ(material.alpha, Material::Alpha::Opaque);
  EXPECT_FALSE(material.is_double_sided);
  EXPECT_FALSE(material.is_unlit);
  EXPECT_FALSE(material.diffuse_map.is_used());
  EXPECT_TRUE(model.images.empty());  // nothing uses it
  EXPECT_EQ(model.mesh.triangle_materials, std::vector<std::uint32_t>{0});
}

TEST(GltfMaterials, HaveFactorsAndMaps) {
  const Model model = read(
      "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.25,0.5,0.75,0.5],\"metallicFactor\":0.125,\"roughnessFactor\":"
      "0.375,\"baseColorTexture\":{\"index\":1},\"metallicRoughnessTexture\":{\"index\":0}},\"normalTexture\":{"
      "\"index\":0,"
      "\"scale\":2},\"emissiveFactor\":[1,0.5,0],\"emissiveTexture\":{\"index\":0},\"alphaMode\":\"MASK\","
      "\"alphaCutoff\":"
      "0.75,\"doubleSided\":true,\"extensions\":{\"KHR_materials_unlit\":{},\"KHR_materials_emissive_strength\":{"
      "\"emissiveStrength\":4}}}");
  const Material& material = model.materials[0];
  EXPECT_EQ(material.diffuse, Vector(0.25f, 0.5f, 0.75f));
  EXPECT_EQ(material.opacity, 0.5f);
  EXPECT_EQ(material.metallic, 0.125f);
  EXPECT_EQ(material.roughness, 0.375f);
  EXPECT_EQ(material.emission, Vector(4, 2, 0));
  EXPECT_EQ(material.alpha, Material::Alpha::Mask);
  EXPECT_EQ(material.alpha_cutoff, 0.75f);
  EXPECT_TRUE(material.is_double_sided);
  EXPECT_TRUE(material.is_unlit);
  EXPECT_EQ(material.normal_map.strength, 2);
  EXPECT_EQ(material.roughness_map.channel, 1);
  EXPECT_EQ(material.metallic_map.channel, 2);
  for (const TextureUse* const map : {&material.diffuse_map, &material.roughness_map, &material.metallic_map,
                                      &material.normal_map, &material.emission_map}) {
    EXPECT_EQ(map->image, 0u);
    EXPECT_TRUE(map->is_v_down);
  }
  EXPECT_EQ(material.diffuse_map.wrap_u, TextureUse::Wrap::Clamp);
  EXPECT_EQ(material.diffuse_map.wrap_v, TextureUse::Wrap::Mirror);
  EXPECT_FALSE(material.diffuse_map.is_smooth);
  EXPECT_EQ(material.normal_map.wrap_u, TextureUse::Wrap::Repeat);
  EXPECT_TRUE(material.normal_map.is_smooth);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(std::string(model.images[0].bytes.begin(), model.images[0].bytes.end()), kPng);
  EXPECT_TRUE(model.warnings.empty());
}

TEST(GltfMaterials, AreOpaqueWhateverTheAlphaUnlessTheySayOtherwise) {
  const std::string factor = "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.5]}";
  EXPECT_EQ(read("{" + factor + "}").materials[0].opacity, 1);
  const Material blend = read("{\"alphaMode\":\"BLEND\"," + factor + "}").materials[0];
  EXPECT_EQ(blend.alpha, Material::Alpha::Blend);
  EXPECT_EQ(blend.opacity, 0.5f);
}

TEST(GltfMaterials, TransformTextures) {
  const std::string info =
      "{\"index\":0,\"texCoord\":1,\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0.25],\"rotation\":1.5,"
      "\"scale\":[2,-3],\"texCoord\":0}}}";
  const TextureUse use =
      read("{\"pbrMetallicRoughness\":{\"baseColorTexture\":" + info + "}}").materials[0].diffuse_map;
  EXPECT_EQ(use.offset, glm::vec2(0.5f, 0.25f));
  EXPECT_EQ(use.scale, glm::vec2(2, -3));
  EXPECT_EQ(use.rotation, -1.5f);  // counter-clockwise with v down: from u to -v
}

TEST(GltfMaterials, UseTheTextureCoordinatesOfTheBaseColour) {
  GltfText gltf = triangle_text();
  gltf.accessor(bytes_of<float>({0, 0, 1, 0, 0, 1}), kFloat32, "VEC2", 3);
  gltf.accessor(bytes_of<float>({5, 5, 6, 5, 5, 6}), kFloat32, "VEC2", 3);
  const int view = gltf.view(kPng);
  const Model model = read_gltf(
      gltf.text(
          "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,"
          "\"TEXCOORD_1\":2},\"material\":0}]}],\"images\":[{\"bufferView\":" +
          std::to_string(view) +
          "}],\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{"
          "\"index\":0,\"texCoord\":1}},\"normalTexture\":{\"index\":0},\"emissiveTexture\":{\"index\":0,"
          "\"texCoord\":1}}]"),
      "t.gltf", ".");
  EXPECT_EQ(model.mesh.texture_coordinates[0], glm::vec2(5, 5));
  EXPECT_TRUE(model.materials[0].emission_map.is_used());
  EXPECT_FALSE(model.materials[0].normal_map.is_used());
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("materials[0].normalTexture"), std::string::npos) << model.warnings[0];
}

TEST(GltfMaterials, OfSpecularAndGlossinessArePhong) {
  const Material material =
      read(
          "{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":[0.5,0.5,0.5,1],"
          "\"specularFactor\":"
          "[0.25,0.25,0.25],\"glossinessFactor\":0.5,\"diffuseTexture\":{\"index\":0},\"specularGlossinessTexture\":{"
          "\"index\":0}}}}")
          .materials[0];
  EXPECT_EQ(material.kind, Material::Kind::Phong);
  EXPECT_EQ(material.diffuse, Vector(0.5f));
  EXPECT_EQ(material.specular, Vector(0.25f));
  EXPECT_FLOAT_EQ(material.shininess, 30);  // roughness 1/2, alpha 1/4: 2 * 16 - 2
  EXPECT_TRUE(material.diffuse_map.is_used());
  EXPECT_TRUE(material.specular_map.is_used());
}

TEST(GltfMaterials, GoOnWithoutImagesThatAreNotThere) {
  const auto use = [](const std::string& image) {
    return read("{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2}}}", ",{\"source\":1}", "," + image);
  };
  const auto expect_warning = [&](const std::string& image, const std::string& part) {
    const Model model = use(image);
    EXPECT_FALSE(model.materials[0].diffuse_map.is_used());
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_NE(model.warnings[0].find(part), std::string::npos) << model.warnings[0];
  };
  expect_warning("{\"uri\":\"none.png\"}", "texture not found: none.png");
  expect_warning("{\"uri\":\"../../etc/x.png\"}", "outside the model's folder");
  expect_warning("{\"uri\":\"data:image/webp;base64,AAAA\"}", "neither PNG nor JPEG");
  expect_warning("{\"uri\":\"data:image/png;base64,!\"}", "cannot be read");
  EXPECT_EQ(use("{\"uri\":\"data:image/png;base64," + base64(kPng) + "\"}").images.size(), 1u);
}

}  // namespace
}  // namespace facemap
