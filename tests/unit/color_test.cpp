#include <facemap/color.h>
#include <facemap/image_file.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "image/srgb.h"

namespace {

using facemap::Color;

/// The encoded value times 255, before rounding, by the C library: IEC 61966-2-1.
double encoded_255(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

int level(float linear) { return static_cast<int>(Color{linear, 0, 0}.to_24_bit() >> 16); }

/// The smallest float of level `wanted` or more.
float where_level_begins(int wanted) {
  float below = 0, above = 1;
  while (std::nextafter(below, above) < above) {
    const float middle = below + (above - below) / 2;
    (level(middle) >= wanted ? above : below) = middle;
  }
  return above;
}

TEST(Color, RoundsToTheNearestLevel) {
  for (int wanted = 1; wanted < 256; ++wanted) {
    const float first = where_level_begins(wanted);
    const float last_before = std::nextafter(first, 0.0f);
    EXPECT_GE(encoded_255(first), wanted - 0.5 - 1e-12) << wanted;  // 1e-12 levels: the C library's own rounding
    EXPECT_LE(encoded_255(last_before), wanted - 0.5 + 1e-12) << wanted;
  }
}

TEST(Color, NoFloatIsTooNearHalfWayToBeSure) {
  // The table's half-way points have relative errors below 2^-46; every float is 2^-40 away from them or more.
  for (int wanted = 1; wanted < 256; ++wanted) {
    const double encoded = (wanted - 0.5) / 255;
    const double half_way = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    const double off = std::fabs(static_cast<double>(static_cast<float>(half_way)) - half_way);
    EXPECT_GT(off, half_way * 0x1p-40) << wanted;
  }
}

TEST(Color, LevelsGrowWithTheValue) {
  int before = 0;
  for (int i = 0; i <= 1 << 20; ++i) {
    const int now = level(static_cast<float>(i) * 0x1p-20f);
    ASSERT_TRUE(now == before || now == before + 1) << i;
    before = now;
  }
  EXPECT_EQ(before, 255);
}

TEST(Color, ClampsAndTakesNanAsBlack) {
  EXPECT_EQ((Color{-1, 2, std::nanf("")}).to_24_bit(), 0x00ff00u);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ((Color{infinity, -infinity, 0}).to_24_bit(), 0xff0000u);
  EXPECT_EQ((Color{-0.0f, std::numeric_limits<float>::denorm_min(), 1}).to_24_bit(), 0x0000ffu);
}

TEST(Color, ChannelsStandInTheirPlaces) {
  EXPECT_EQ((Color{1, 0.5f, 0.25f}).to_24_bit(), 0xffbc89u);
  EXPECT_EQ((Color{0.2158605f, 0, 1}).to_24_bit(), 0x8000ffu);
}

TEST(Color, EveryLevelComesBack) {
  for (std::uint32_t level = 0; level < 256; ++level) {
    const std::uint32_t rgb = level << 16 | (255 - level) << 8 | (level * 7 & 255);
    EXPECT_EQ(Color::from_24_bit(rgb).to_24_bit(), rgb);
  }
}

TEST(Color, SixteenBitLevelsAreRoundedToTheNearest) {
  facemap::Image image;
  image.width = 1 << 16;
  image.height = 1;
  for (int i = 0; i < image.width; ++i) {
    const float linear = static_cast<float>(i) * 0x1p-16f;
    image.pixels.push_back({linear, linear * linear, 1 - linear});
  }
  const std::vector<std::uint16_t> srgb = levels_16(image, facemap::Transfer::Srgb);
  const std::vector<std::uint16_t> linear = levels_16(image, facemap::Transfer::Linear);
  constexpr double kSlack = 1e-9;  // levels: the C library's own rounding
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Color& color = image.pixels[i];
    ASSERT_NEAR(srgb[3 * i], 257 * encoded_255(color.r), 0.5 + kSlack) << i;
    ASSERT_NEAR(srgb[3 * i + 1], 257 * encoded_255(color.g), 0.5 + kSlack) << i;
    ASSERT_NEAR(linear[3 * i + 2], 65535.0 * color.b, 0.5 + kSlack) << i;
  }
  for (const int threads : {1, 2, 3}) EXPECT_TRUE(levels_16(image, facemap::Transfer::Srgb, threads) == srgb);
}

TEST(Color, SixteenBitLevelsAreClampedAndNanIsBlack) {
  const float infinity = std::numeric_limits<float>::infinity();
  facemap::Image image;
  image.width = 2;
  image.height = 1;
  image.pixels = {{-1, 2, std::nanf("")}, {infinity, -infinity, 1}};
  const std::vector<std::uint16_t> expected = {0, 65535, 0, 65535, 0, 65535};
  EXPECT_EQ(levels_16(image, facemap::Transfer::Srgb), expected);
  EXPECT_EQ(levels_16(image, facemap::Transfer::Linear), expected);
  EXPECT_EQ(levels_8(image), (std::vector<std::uint8_t>{0, 255, 0, 255, 0, 255}));
}

TEST(Color, AddsSubtractsAndMultiplies) {
  const Color a{1, 2, 3}, b{0.5f, 0.25f, 2};
  EXPECT_EQ(a + b, (Color{1.5f, 2.25f, 5}));
  EXPECT_EQ(a - b, (Color{0.5f, 1.75f, 1}));
  EXPECT_EQ(a * 2, (Color{2, 4, 6}));
  EXPECT_EQ(a * b, (Color{0.5f, 0.5f, 6}));
}

TEST(Color, ManyAtOnceAreTheSame) {
  std::vector<float> values = {0, -0.0f, -1, 1, 2, 0.5f, 1e-45f, 1e-30f, 3e38f};
  for (const float odd : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::infinity(), std::nextafter(1.0f, 0.0f)}) {
    values.push_back(odd);
  }
  for (int wanted = 1; wanted < 256; ++wanted) {
    const float first = where_level_begins(wanted);
    values.insert(values.end(), {first, std::nextafter(first, 0.0f), std::nextafter(first, 1.0f)});
  }
  for (int i = 0; i <= 9000; ++i) values.push_back(static_cast<float>(i) / 8192);
  values.insert(values.end(), 30, 0.125f);  // the same colour again and again
  while (values.size() % 3 != 0) values.push_back(0.25f);
  std::vector<Color> colors;
  for (std::size_t i = 0; i < values.size(); i += 3) colors.push_back({values[i], values[i + 1], values[i + 2]});

  for (const std::size_t count : {colors.size(), std::size_t{1}, std::size_t{5}, std::size_t{6}}) {
    std::vector<std::uint8_t> bytes(3 * count + 1, 77);
    facemap::encode_srgb(colors.data(), count, bytes.data());
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t rgb = std::uint32_t{bytes[3 * i]} << 16 | bytes[3 * i + 1] << 8 | bytes[3 * i + 2];
      ASSERT_EQ(rgb, colors[i].to_24_bit()) << i;
    }
    EXPECT_EQ(bytes.back(), 77) << "nothing is written behind the end";
  }
}

}  // namespace
