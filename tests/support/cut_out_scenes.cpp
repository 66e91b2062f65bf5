#include "support/cut_out_scenes.h"

#include <algorithm>
#include <cmath>

#include "support/rgba_png.h"

namespace test_scenes {
namespace {

using namespace facemap;

constexpr int kImages = 3, kMaterials = 5;

TextureImage image_of(Random& random) {
  const int width = random.between(1, 6), height = random.between(1, 6);
  const bool has_alpha = random.chance(0.6);
  const bool is_black_and_white = random.chance(0.5);
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < 4 * width * height; ++i) {
    const int level = is_black_and_white ? 255 * random.below(2) : 32 * random.below(8);
    rgba.push_back(static_cast<std::uint8_t>(i % 4 == 3 && !has_alpha ? 255 : level));
  }
  return {"image.png", {}, rgba_png(width, height, rgba)};
}

TextureUse use_of(Random& random) {
  TextureUse use;
  use.image = static_cast<std::uint32_t>(random.below(kImages));
  use.is_v_down = random.chance(0.5);
  use.wrap_u = static_cast<TextureUse::Wrap>(random.below(3));
  use.wrap_v = static_cast<TextureUse::Wrap>(random.below(3));
  if (random.chance(0.3))
    use.offset = {static_cast<float>(random.between(-8, 8)) * 0.125f, static_cast<float>(random.between(-1.0, 1.0))};
  if (random.chance(0.3))
    use.scale = {static_cast<float>(random.between(-8, 8)) * 0.5f, static_cast<float>(random.between(-2.0, 2.0))};
  if (random.chance(0.3)) use.rotation = static_cast<float>(random.between(-4.0, 4.0));
  if (random.chance(0.2)) {
    use.base = static_cast<float>(random.between(-0.5, 0.5));
    use.gain = static_cast<float>(random.between(-1.0, 2.0));
  }
  if (random.chance(0.4)) use.channel = random.below(4);
  return use;
}

Material material_of(Random& random) {
  Material material;
  material.name = "made up";
  material.alpha = static_cast<Material::Alpha>(random.chance(0.6) ? 1 : random.below(3));
  material.alpha_cutoff = random.chance(0.6) ? static_cast<float>(32 * random.below(9)) / 255.0f
                                             : static_cast<float>(random.between(0.0, 1.0));
  if (random.chance(0.3)) material.opacity = static_cast<float>(random.between(0.0, 1.0));
  if (random.chance(0.6)) material.opacity_map = use_of(random);
  if (random.chance(0.6)) material.diffuse_map = use_of(random);
  return material;
}

}  // namespace

Model with_holes(const TestScene& test, Random& random) {
  Model model;
  model.mesh = test.mesh;
  Mesh& mesh = model.mesh;
  for (int i = 0; i < kImages; ++i) model.images.push_back(image_of(random));
  for (int i = 0; i < kMaterials; ++i) model.materials.push_back(material_of(random));
  const int step = random.between(1, 4);
  for (int i = 0; i < 12; ++i) {
    const bool is_even = random.chance(0.7);
    mesh.texture_coordinates.push_back(is_even ? glm::vec2(random.between(-4, 6), random.between(-4, 6)) /
                                                     static_cast<float>(step)
                                               : glm::vec2(random.between(-2.0, 3.0), random.between(-2.0, 3.0)));
  }
  // Some meshes are solid to begin with, so that closed parts stay closed.
  const double solid_share = random.chance(0.3) ? 0.2 : random.unit();
  const bool is_in_order = random.chance(0.5);
  const auto count = static_cast<double>(mesh.face_count());
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const bool is_solid = is_in_order ? static_cast<double>(face) < solid_share * count : random.chance(solid_share);
    mesh.triangle_materials.push_back(is_solid ? kNoIndex : static_cast<std::uint32_t>(random.below(kMaterials)));
    Corners corners;
    for (std::uint32_t& corner : corners) {
      corner = random.chance(0.05) ? kNoIndex : static_cast<std::uint32_t>(random.below(12));
    }
    mesh.texture_corners.push_back(corners);
  }
  return model;
}

}  // namespace test_scenes
