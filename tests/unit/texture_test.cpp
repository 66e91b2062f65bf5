#include "material/texture.h"

#include <facemap/color.h>
#include <gtest/gtest.h>

#include <cmath>

#include "material/texel_codes.h"
#include "math/elementary.h"
#include "scene/texture_place.h"

namespace facemap {
namespace {

using Wrap = TextureUse::Wrap;

// Half a level of 8 bits, as linear light where sRGB is steepest.
constexpr float kHalfLevel = 0.5f * 2.4f / 1.055f / 255;

DecodedImage image_of(int width, int height, const std::vector<std::uint32_t>& rgb) {
  DecodedImage image;
  image.width = width;
  image.height = height;
  for (const std::uint32_t value : rgb) {
    for (const int shift : {16, 8, 0}) image.rgba.push_back(static_cast<std::uint8_t>(value >> shift));
    image.rgba.push_back(255);
  }
  return image;
}

// Black and white squares of one texel, white first.
Texture checkerboard(int size, Encoding encoding = Encoding::Linear) {
  std::vector<std::uint32_t> rgb;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) rgb.push_back((x + y) % 2 == 0 ? 0xffffff : 0);
  }
  return Texture(image_of(size, size, rgb), encoding);
}

// Texels that say where they are: red is the column, green the row.
Texture numbered(int width, int height) {
  std::vector<std::uint32_t> rgb;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) rgb.push_back(static_cast<std::uint32_t>(x << 16 | y << 8));
  }
  return Texture(image_of(width, height, rgb), Encoding::Linear);
}

struct Texel {
  int x, y;
  bool operator==(const Texel&) const = default;
};

Texel texel_at(const Texture& texture, double x, double y, Wrap wrap) {
  TextureUse use;
  use.wrap_u = use.wrap_v = wrap;
  use.is_smooth = false;
  const TextureValue value = texture.at({x, y}, {}, use);
  return {static_cast<int>(std::lround(value.r * 255)), static_cast<int>(std::lround(value.g * 255))};
}

TEST(Texture, PlacesRunFromTheUpperLeftCorner) {
  const Texture texture = numbered(5, 3);
  EXPECT_EQ(texel_at(texture, 0.1, 0.1, Wrap::Repeat), (Texel{0, 0}));
  EXPECT_EQ(texel_at(texture, 0.9, 0.1, Wrap::Repeat), (Texel{4, 0}));
  EXPECT_EQ(texel_at(texture, 0.5, 0.9, Wrap::Repeat), (Texel{2, 2}));
}

TEST(Texture, Wraps) {
  const Texture texture = numbered(4, 2);
  EXPECT_EQ(texel_at(texture, 1.1, -0.1, Wrap::Repeat), (Texel{0, 1}));
  EXPECT_EQ(texel_at(texture, -0.1, 5.6, Wrap::Repeat), (Texel{3, 1}));
  EXPECT_EQ(texel_at(texture, 1.1, -0.1, Wrap::Mirror), (Texel{3, 0}));
  EXPECT_EQ(texel_at(texture, -0.3, 1.6, Wrap::Mirror), (Texel{1, 0}));
  EXPECT_EQ(texel_at(texture, 2.1, 4.1, Wrap::Mirror), (Texel{0, 0}));
  EXPECT_EQ(texel_at(texture, 1.1, -7.0, Wrap::Clamp), (Texel{3, 0}));
  EXPECT_EQ(texel_at(texture, -1e30, 1e30, Wrap::Clamp), (Texel{0, 0})) << "too far away to tell";
  for (const Wrap wrap : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp}) {
    for (const double x : {double{NAN}, double{INFINITY}, -1e300, -1e-300, 1.0, 2.0, -1.0, 1 - 0x1p-53, -0x1p-60}) {
      const Texel texel = texel_at(texture, x, x, wrap);
      EXPECT_TRUE(texel.x >= 0 && texel.x < 4 && texel.y >= 0 && texel.y < 2) << x;
      TextureUse use;
      use.wrap_u = use.wrap_v = wrap;
      EXPECT_TRUE(std::isfinite(texture.at({x, x}, {}, use).r));
    }
  }
}

TEST(Texture, InterpolatesBetweenCentresOfTexels) {
  const Texture texture(image_of(2, 1, {0x000000, 0xffffff}), Encoding::Linear);
  TextureUse use;
  use.wrap_u = Wrap::Clamp;
  EXPECT_EQ(texture.at({0.25, 0.5}, {}, use).r, 0);
  EXPECT_EQ(texture.at({0.75, 0.5}, {}, use).r, 1);
  EXPECT_FLOAT_EQ(texture.at({0.5, 0.5}, {}, use).r, 0.5f);
  EXPECT_EQ(texture.at({0.0, 0.5}, {}, use).r, 0);
  use.wrap_u = Wrap::Repeat;
  EXPECT_FLOAT_EQ(texture.at({0.0, 0.5}, {}, use).r, 0.5f) << "the other end is next to it";
}

TEST(Texture, ColoursAreLinearLight) {
  const Texture texture(image_of(1, 1, {0x80ff00}), Encoding::Srgb);
  const TextureValue value = texture.at({0.5, 0.5}, {}, {});
  EXPECT_EQ(value.r, Color::from_24_bit(0x808080).r);
  EXPECT_EQ(value.g, 1);
  EXPECT_EQ(value.b, 0);
  EXPECT_EQ(value.a, 1);
  EXPECT_FLOAT_EQ(Texture(image_of(1, 1, {0x80ff00}), Encoding::Linear).at({0.5, 0.5}, {}, {}).r, 128 / 255.0f);
}

TEST(Texture, LevelsKeepTheMeanOfAnySize) {
  for (const auto& [width, height] : {std::pair{7, 5}, {1, 9}, {64, 3}, {31, 33}}) {
    std::vector<std::uint32_t> rgb;
    double sum = 0;
    for (int i = 0; i < width * height; ++i) {
      rgb.push_back(static_cast<std::uint32_t>(i * 37 % 256) << 16);
      sum += i * 37 % 256;
    }
    const Texture texture(image_of(width, height, rgb), Encoding::Linear);
    const Footprint all{{10, 0}, {0, 10}};
    EXPECT_NEAR(texture.at({0.3, 0.7}, all, {}).r, sum / (255 * width * height), 0.51f / 255) << width;
  }
}

TEST(Texture, MeansAreOfLightAndNotOfLevels) {
  const Texture texture = checkerboard(16, Encoding::Srgb);
  EXPECT_NEAR(texture.at({0.4, 0.4}, {{1, 0}, {0, 1}}, {}).r, 0.5f, kHalfLevel);
}

// From one texel across to the whole: the mean stays, and the pattern fades without a jump.
TEST(Texture, ACheckerboardFadesToItsMean) {
  const Texture texture = checkerboard(64);
  float last = 1;
  for (double size = 0.5; size < 64; size *= 1.05) {
    const Footprint footprint{{size / 64, 0}, {0, size / 64}};
    const float value = texture.at({0.5 / 64, 0.5 / 64}, footprint, {}).r;  // the middle of a white texel
    EXPECT_LE(value, last + 0.01f) << size;
    EXPECT_GT(value, last - 0.06f) << size;  // no jump
    EXPECT_NEAR(value, 0.5f, size >= 2 ? 1 / 255.0f : 0.5f) << size;
    last = value;
  }
}

// At a grazing angle a footprint is long and narrow: along its length the squares average out, across it stripes stay.
TEST(Texture, AGrazingCheckerboardBecomesItsMeanAndStripesStay) {
  const Texture squares = checkerboard(64);
  for (const double x : {0.0, 0.013, 0.4}) {
    EXPECT_NEAR(squares.at({x, 0.5 / 64}, {{8.0 / 64, 0}, {0, 0.5 / 64}}, {}).r, 0.5f, 0.01f) << x;
    EXPECT_NEAR(squares.at({x, 0.2}, {{900.0 / 64, 3.0 / 64}, {1, 0.5 / 64}}, {}).r, 0.5f, 0.01f) << x;
  }
  std::vector<std::uint32_t> rows;
  for (int i = 0; i < 64 * 64; ++i) rows.push_back(i / 64 % 2 == 0 ? 0xffffff : 0);
  const Texture stripes(image_of(64, 64, rows), Encoding::Linear);
  EXPECT_EQ(stripes.at({0.3, 0.5 / 64}, {{8.0 / 64, 0}, {0, 1.0 / 64}}, {}).r, 1);
  EXPECT_EQ(stripes.at({0.3, 1.5 / 64}, {{8.0 / 64, 0}, {0, 1.0 / 64}}, {}).r, 0);
  EXPECT_NEAR(stripes.at({0.3, 0.5 / 64}, {{0, 8.0 / 64}, {1.0 / 64, 0}}, {}).r, 0.5f, 0.01f);
}

TEST(Texture, AFootprintHasNoDirectionOfItsOwn) {
  const Texture texture = numbered(64, 64);
  const Footprint turned{{0.03, 0.01}, {-0.01, 0.03}}, swapped{{-0.01, 0.03}, {0.03, 0.01}};
  EXPECT_FLOAT_EQ(texture.at({0.5, 0.5}, turned, {}).r, texture.at({0.5, 0.5}, swapped, {}).r);
  EXPECT_DOUBLE_EQ(texture.texels_across({{4.0 / 64, 0}, {0, 2.0 / 64}}), 2);
  EXPECT_DOUBLE_EQ(texture.texels_across({{0, 0}, {0, 0}}), 1);
}

// Green leaves on clear black: whatever the size of a sample, what is seen of them is green.
TEST(Texture, ClearTexelsDoNotDarkenWhatIsCutOut) {
  DecodedImage image;
  image.width = image.height = 8;
  image.has_alpha = true;
  for (int i = 0; i < 64; ++i) {
    const bool is_leaf = i % 8 < 3;
    for (const int level : {0, is_leaf ? 255 : 0, 0, is_leaf ? 255 : 0}) {
      image.rgba.push_back(static_cast<std::uint8_t>(level));
    }
  }
  const Texture texture(std::move(image), Encoding::CutOuts);
  const TextureUse use;
  for (const double size : {0.01, 0.125, 0.3, 1.0}) {
    for (double x = 0.05; x < 1; x += 0.1) {
      const TextureValue value = texture.at({x, 0.5}, {{size, 0}, {0, size}}, use);
      EXPECT_FLOAT_EQ(value.g, 1) << "at " << x << ", size " << size;
      EXPECT_EQ(value.r, 0);
    }
  }
  EXPECT_NEAR(texture.at({0.5, 0.5}, {{1, 0}, {0, 1}}, use).a, 3 / 8.0, 1 / 255.0);
}

TEST(TexturePlace, TurnsUTowardsVAndFlipsWhatGoesUp) {
  TextureUse use;
  TexturePoint p = TexturePlace(use).at({0.25, 0.25});
  EXPECT_DOUBLE_EQ(p.x, 0.25);
  EXPECT_DOUBLE_EQ(p.y, 0.75) << "v goes up in an MTL file";
  use.is_v_down = true;
  EXPECT_DOUBLE_EQ(TexturePlace(use).at({0.25, 0.25}).y, 0.25);
  use.rotation = static_cast<float>(elementary::kPi / 2);
  use.scale = {2, 3};
  use.offset = {0.5f, 0.25f};
  p = TexturePlace(use).at({0.1, 0.2});
  EXPECT_NEAR(p.x, 0.5 - 0.6, 1e-7);
  EXPECT_NEAR(p.y, 0.25 + 0.2, 1e-7);
  const Footprint moved = Footprint{{1, 0}, {0, 1}}.on(TexturePlace(use));
  EXPECT_NEAR(moved.right.y, 2, 1e-6);
  EXPECT_NEAR(moved.down.x, -3, 1e-6);
}

TEST(TexelCodes, BytesComeBack) {
  for (const bool is_srgb : {false, true}) {
    std::vector<float> values;
    for (int i = 0; i < 256; ++i) {
      for (int k = 0; k < 3; ++k) values.push_back(linear_values(is_srgb)[i]);
      values.push_back(static_cast<float>(i) / 255);
    }
    const std::vector<std::uint8_t> bytes = encoded(values, is_srgb);
    for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], i / 4) << is_srgb;
  }
}

}  // namespace
}  // namespace facemap
