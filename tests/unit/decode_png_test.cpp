#include "image/decode_png.h"

#include <facemap/error.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <string>

namespace facemap {
namespace {

constexpr std::uint64_t kMaxPixels = 1 << 20;

using Bytes = std::vector<std::uint8_t>;

/// What to write: samples are 0..2^depth - 1, channels of a pixel side by side.
struct Picture {
  int width = 0, height = 0, color_type = PNG_COLOR_TYPE_GRAY, depth = 8;
  std::vector<std::uint16_t> samples;
  bool is_interlaced = false, is_keyed = false;  ///< keyed: tRNS makes the first pixel's colour transparent
  double gamma = 0;

  int channels() const {
    const int colours = color_type & PNG_COLOR_MASK_COLOR && !(color_type & PNG_COLOR_MASK_PALETTE) ? 3 : 1;
    return colours + (color_type & PNG_COLOR_MASK_ALPHA ? 1 : 0);
  }
  std::uint16_t sample(int pixel, int channel) const {
    return samples[static_cast<std::size_t>(pixel * channels() + channel)];
  }
};

/// A palette of 2^depth colours: index i is (i, 255 - i, 3 i mod 256), of alpha 7 i mod 256 if it is keyed.
std::uint8_t palette_level(int index, int channel) {
  const int levels[] = {index, 255 - index, 3 * index & 255, 7 * index & 255};
  return static_cast<std::uint8_t>(levels[channel]);
}

/// Every sample its own value as far as there are so many.
Picture make_picture(int color_type, int depth, bool is_interlaced, bool is_keyed) {
  Picture picture{13, 11, color_type, depth, {}, is_interlaced, is_keyed};
  std::uint32_t state = 1;
  for (int i = 0; i < picture.width * picture.height * picture.channels(); ++i) {
    state = state * 1664525 + 1013904223;
    picture.samples.push_back(static_cast<std::uint16_t>(state >> 16 & ((1u << depth) - 1)));
  }
  return picture;
}

void append(png_structp png, png_bytep bytes, std::size_t size) {
  Bytes& file = *static_cast<Bytes*>(png_get_io_ptr(png));
  file.insert(file.end(), bytes, bytes + size);
}

void set_key(png_structp png, png_infop info, const Picture& picture) {
  if (picture.color_type == PNG_COLOR_TYPE_PALETTE) {
    Bytes alphas;
    for (int i = 0; i < 1 << picture.depth; ++i) alphas.push_back(palette_level(i, 3));
    png_set_tRNS(png, info, alphas.data(), static_cast<int>(alphas.size()), nullptr);
    return;
  }
  png_color_16 key{};
  key.gray = key.red = picture.sample(0, 0);
  if (picture.channels() == 3) {
    key.green = picture.sample(0, 1);
    key.blue = picture.sample(0, 2);
  }
  png_set_tRNS(png, info, nullptr, 0, &key);
}

/// The samples of row `y`, most significant bit first.
Bytes pack_row(const Picture& picture, int y) {
  Bytes row;
  unsigned bits = 0, count = 0;
  const int a_row = picture.width * picture.channels();
  for (int i = y * a_row; i < (y + 1) * a_row; ++i) {
    bits = bits << picture.depth | picture.samples[static_cast<std::size_t>(i)];
    count += static_cast<unsigned>(picture.depth);
    for (; count >= 8; count -= 8) row.push_back(static_cast<std::uint8_t>(bits >> (count - 8)));
  }
  if (count > 0) row.push_back(static_cast<std::uint8_t>(bits << (8 - count)));
  return row;
}

Bytes write(const Picture& picture) {
  Bytes file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &file, &append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height),
               picture.depth, picture.color_type, picture.is_interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  if (picture.color_type == PNG_COLOR_TYPE_PALETTE) {
    std::vector<png_color> palette;
    for (int i = 0; i < 1 << picture.depth; ++i)
      palette.push_back({palette_level(i, 0), palette_level(i, 1), palette_level(i, 2)});
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  }
  if (picture.is_keyed) set_key(png, info, picture);
  if (picture.gamma > 0) png_set_gAMA(png, info, picture.gamma);
  png_write_info(png, info);
  const int passes = png_set_interlace_handling(png);
  for (int pass = 0; pass < passes; ++pass) {
    for (int y = 0; y < picture.height; ++y) png_write_row(png, pack_row(picture, y).data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

bool is_key(const Picture& picture, int pixel) {
  for (int k = 0; k < picture.channels(); ++k) {
    if (picture.sample(pixel, k) != picture.sample(0, k)) return false;
  }
  return picture.is_keyed;
}

/// What the format's description says of one channel of RGBA, rounded to 0..most.
int expected_level(const Picture& picture, int pixel, int channel, int most) {
  if (picture.color_type == PNG_COLOR_TYPE_PALETTE) {
    const int level = channel == 3 && !picture.is_keyed ? 255 : palette_level(picture.sample(pixel, 0), channel);
    return level * most / 255;
  }
  const bool has_alpha = picture.color_type & PNG_COLOR_MASK_ALPHA;
  if (channel == 3 && !has_alpha) return is_key(picture, pixel) ? 0 : most;
  const int colours = picture.channels() - (has_alpha ? 1 : 0);
  const int sample = picture.sample(pixel, channel == 3 ? colours : colours == 3 ? channel : 0);
  return static_cast<int>(std::lround(static_cast<double>(sample) * most / ((1 << picture.depth) - 1)));
}

void expect_picture(const Picture& picture) {
  SCOPED_TRACE("colour type " + std::to_string(picture.color_type) + ", depth " + std::to_string(picture.depth) +
               (picture.is_interlaced ? ", interlaced" : "") + (picture.is_keyed ? ", tRNS" : ""));
  const Bytes file = write(picture);
  const DecodedImage image = decode_png(file, "a.png", kMaxPixels);
  const DecodedImage16 image_16 = decode_png_16(file, "a.png", kMaxPixels);
  ASSERT_EQ(image.width, picture.width);
  ASSERT_EQ(image.height, picture.height);
  ASSERT_EQ(image.rgba.size(), std::size_t{4 * 13 * 11});
  ASSERT_EQ(image_16.rgba.size(), std::size_t{4 * 13 * 11});
  bool has_alpha = false;
  for (int i = 0; i < picture.width * picture.height; ++i) {
    for (int k = 0; k < 4; ++k) {
      const auto at = static_cast<std::size_t>(4 * i + k);
      ASSERT_EQ(image.rgba[at], expected_level(picture, i, k, 255)) << "pixel " << i << ", channel " << k;
      ASSERT_EQ(image_16.rgba[at], expected_level(picture, i, k, 65535)) << "pixel " << i << ", channel " << k;
    }
    has_alpha = has_alpha || expected_level(picture, i, 3, 255) != 255;
  }
  EXPECT_EQ(image.has_alpha, has_alpha);
}

TEST(DecodePng, ReadsEveryColourTypeAndDepth) {
  const std::pair<int, std::vector<int>> kinds[] = {{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                                                    {PNG_COLOR_TYPE_RGB, {8, 16}},
                                                    {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                                                    {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                                    {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}};
  for (const auto& [color_type, depths] : kinds) {
    for (const int depth : depths) {
      for (const bool is_interlaced : {false, true}) {
        expect_picture(make_picture(color_type, depth, is_interlaced, false));
        if (!(color_type & PNG_COLOR_MASK_ALPHA)) expect_picture(make_picture(color_type, depth, is_interlaced, true));
      }
    }
  }
}

TEST(DecodePng, IgnoresGamma) {
  Picture picture = make_picture(PNG_COLOR_TYPE_RGB, 8, false, false);
  picture.gamma = 1;
  expect_picture(picture);
}

std::string refusal(const Bytes& bytes, std::uint64_t max_pixels = kMaxPixels) {
  try {
    decode_png(bytes, "a.png", max_pixels);
  } catch (const LoadError& error) {
    EXPECT_EQ(error.file(), "a.png");
    EXPECT_EQ(error.cause(), error.reason().find("are allowed") == std::string::npos ? LoadError::Cause::BadImage
                                                                                     : LoadError::Cause::TooLarge);
    return error.what();
  }
  return "none";
}

TEST(DecodePng, RefusesEveryFileCutShort) {
  for (const bool is_interlaced : {false, true}) {
    const Bytes file = write(make_picture(PNG_COLOR_TYPE_RGB, 8, is_interlaced, false));
    for (std::size_t kept = 8; kept < file.size(); ++kept) {
      EXPECT_EQ(refusal(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(kept))),
                "a.png: PNG cannot be read: it ends too early");
    }
  }
}

TEST(DecodePng, RefusesChangedBytesOfThePicture) {
  const Bytes file = write(make_picture(PNG_COLOR_TYPE_RGB, 8, false, false));
  int refused = 0;
  for (std::size_t at = 8; at < file.size(); ++at) {
    Bytes changed = file;
    changed[at] ^= 0x10;
    refused += refusal(changed) != "none";
  }
  EXPECT_EQ(refused, static_cast<int>(file.size() - 8)) << "a sum guards every byte";
}

TEST(DecodePng, RefusesSizesBeforeItTakesMemory) {
  const Bytes file = write(make_picture(PNG_COLOR_TYPE_RGB, 8, false, false));
  EXPECT_EQ(refusal(file, 142), "a.png: a picture of 13x11 pixels; at most 142 pixels are allowed");
  EXPECT_EQ(refusal(file, 143), "none");

  Picture wide{500'000, 1, PNG_COLOR_TYPE_RGB, 16, std::vector<std::uint16_t>(1'500'000)};
  Bytes large = write(wide);
  ASSERT_LT(large.size(), 8000u);
  EXPECT_EQ(refusal(large), "none") << "zeros are what compresses best";
  large.resize(1000);
  EXPECT_EQ(refusal(large), "a.png: the header promises more than 1000 bytes can hold");
}

}  // namespace
}  // namespace facemap
