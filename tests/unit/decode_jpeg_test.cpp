#include "image/decode_jpeg.h"

#include <facemap/error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
// jpeglib.h needs size_t and FILE.
#include <jpeglib.h>

namespace facemap {
namespace {

constexpr std::uint64_t kMaxPixels = 1 << 20;

/// Levels of the largest difference after coding at quality 100: the transform there and back, and the conversion
/// between RGB and YCbCr, which rounds twice.
constexpr int kRounding = 3;

using Bytes = std::vector<std::uint8_t>;
using Settings = std::function<void(jpeg_compress_struct&)>;

constexpr int kWidth = 43, kHeight = 29;

/// Smooth, so that what quality 100 drops is rounding alone: channel `k` of pixel (x, y).
int level(int x, int y, int k) { return k == 0 ? 5 * x : k == 1 ? 8 * y : k == 2 ? 250 - 3 * x : 60 + 2 * x + 3 * y; }

/// A file of `channels` channels of the colour space, quality 100, no subsampling, if `change` has it no other way.
Bytes write(int channels, J_COLOR_SPACE space, const Settings& change = {}) {
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = kWidth;
  jpeg.image_height = kHeight;
  jpeg.input_components = channels;
  jpeg.in_color_space = space;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  for (int k = 0; k < jpeg.num_components; ++k) jpeg.comp_info[k].h_samp_factor = jpeg.comp_info[k].v_samp_factor = 1;
  if (change) change(jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  for (int y = 0; y < kHeight; ++y) {
    Bytes row;
    for (int x = 0; x < kWidth; ++x) {
      for (int k = 0; k < channels; ++k) row.push_back(static_cast<std::uint8_t>(level(x, y, k)));
    }
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  const Bytes file(memory, memory + size);
  jpeg_destroy_compress(&jpeg);
  std::free(memory);
  return file;
}

void subsample(jpeg_compress_struct& jpeg) { jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = 2; }

using Expected = std::function<int(int x, int y, int k)>;

void expect_pixels(const Bytes& file, int tolerance, const Expected& expected) {
  const DecodedImage image = decode_jpeg(file, "a.jpg", kMaxPixels);
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  ASSERT_EQ(image.rgba.size(), std::size_t{4 * kWidth * kHeight});
  EXPECT_FALSE(image.has_alpha);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t* const pixel = image.rgba.data() + 4 * (y * kWidth + x);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(pixel[k], expected(x, y, k), tolerance) << x << ',' << y << ',' << k;
      ASSERT_EQ(pixel[3], 255);
    }
  }
}

TEST(DecodeJpeg, ReadsGreyAndColours) {
  expect_pixels(write(1, JCS_GRAYSCALE), kRounding, [](int x, int y, int) { return level(x, y, 0); });
  expect_pixels(write(3, JCS_RGB), kRounding, level);
  expect_pixels(write(3, JCS_RGB, [](auto& jpeg) { jpeg_set_colorspace(&jpeg, JCS_RGB); }), kRounding, level);
  expect_pixels(write(3, JCS_RGB, [](auto& jpeg) { jpeg_simple_progression(&jpeg); }), kRounding, level);
  expect_pixels(write(3, JCS_RGB, [](auto& jpeg) { jpeg.restart_interval = 2; }), kRounding, level);
}

TEST(DecodeJpeg, EnlargesChromaWithATriangleFilter) {
  constexpr int kSlope = 4;  // levels that means of 2 x 2 pixels are off at the picture's border, where slopes end
  expect_pixels(write(3, JCS_RGB, subsample), kRounding + kSlope, level);
}

TEST(DecodeJpeg, ReadsInksAsAdobeWritesThemAndAsTheyAre) {
  const auto light = [](int x, int y, int k) { return (level(x, y, k) * level(x, y, 3) + 127) / 255; };
  const auto through_ink = [](int x, int y, int k) {
    return ((255 - level(x, y, k)) * (255 - level(x, y, 3)) + 127) / 255;
  };
  // Two factors, each off by as much.
  expect_pixels(write(4, JCS_CMYK), 2 * kRounding, light);
  expect_pixels(write(4, JCS_CMYK, [](auto& jpeg) { jpeg_set_colorspace(&jpeg, JCS_YCCK); }), 2 * kRounding, light);
  expect_pixels(write(4, JCS_CMYK, [](auto& jpeg) { jpeg.write_Adobe_marker = FALSE; }), 2 * kRounding, through_ink);
}

TEST(DecodeJpeg, HasTheSamePixelsWithoutSimd) {
  for (const Settings& settings : {Settings{}, Settings{subsample}, Settings{[](auto& jpeg) {
                                     jpeg.comp_info[0].h_samp_factor = 2;
                                     jpeg_simple_progression(&jpeg);
                                   }}}) {
    const Bytes file = write(3, JCS_RGB, settings);
    const Bytes pixels = decode_jpeg(file, "a.jpg", kMaxPixels).rgba;
    ::setenv("JSIMD_FORCENONE", "1", 1);  // read once a thread
    std::thread([&] { EXPECT_EQ(decode_jpeg(file, "a.jpg", kMaxPixels).rgba, pixels); }).join();
    ::unsetenv("JSIMD_FORCENONE");
  }
}

std::string refusal(const Bytes& bytes, std::uint64_t max_pixels = kMaxPixels) {
  try {
    decode_jpeg(bytes, "a.jpg", max_pixels);
  } catch (const LoadError& error) {
    EXPECT_EQ(error.file(), "a.jpg");
    return error.what();
  }
  return "none";
}

TEST(DecodeJpeg, RefusesEveryFileCutShort) {
  for (const Settings& settings : {Settings{}, Settings{[](auto& jpeg) { jpeg_simple_progression(&jpeg); }}}) {
    const Bytes file = write(3, JCS_RGB, settings);
    for (std::size_t kept = 3; kept < file.size(); ++kept) {
      EXPECT_EQ(refusal(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(kept))).find("a.jpg: JPEG "), 0u)
          << kept;
    }
  }
  const Bytes file = write(3, JCS_RGB);
  EXPECT_EQ(refusal(Bytes(file.begin(), file.end() - 300)), "a.jpg: JPEG cannot be read: it ends too early");
}

TEST(DecodeJpeg, RefusesSizesBeforeItTakesMemory) {
  Bytes file = write(3, JCS_RGB);
  EXPECT_EQ(refusal(file, kWidth * kHeight - 1), "a.jpg: a picture of 43x29 pixels; at most 1246 pixels are allowed");
  const std::uint8_t kFrame[] = {0xff, 0xc0};
  const auto frame = std::search(file.begin(), file.end(), kFrame, kFrame + 2);
  ASSERT_NE(frame, file.end());
  std::fill(frame + 5, frame + 9, std::uint8_t{0xf0});  // height and width
  EXPECT_EQ(refusal(file, std::uint64_t{1} << 40).find("a.jpg: the header promises more than "), 0u) << refusal(file);
}

TEST(DecodeJpeg, RefusesWhatFewReadersKnow) {
  EXPECT_EQ(refusal(write(3, JCS_RGB, [](auto& jpeg) { jpeg.arith_code = TRUE; })),
            "a.jpg: JPEG cannot be read: it has arithmetic codes instead of Huffman's");
  EXPECT_EQ(refusal(write(2, JCS_UNKNOWN)),
            "a.jpg: JPEG cannot be read: its channels are neither grey, nor colours, nor inks");
}

TEST(DecodeJpeg, RefusesMoreScansThanAnEncoderWrites) {
  for (const int coefficients : {45, 63}) {  // each in two scans, and all that are left in one
    std::vector<jpeg_scan_info> scans = {{1, {0}, 0, 0, 0, 0}};
    for (int k = 1; k <= coefficients; ++k) scans.push_back({1, {0}, k, k, 0, 1});
    for (int k = 1; k <= coefficients; ++k) scans.push_back({1, {0}, k, k, 1, 0});
    if (coefficients < 63) scans.push_back({1, {0}, coefficients + 1, 63, 0, 0});
    const Bytes file = write(1, JCS_GRAYSCALE, [&](auto& jpeg) {
      jpeg.scan_info = scans.data();
      jpeg.num_scans = static_cast<int>(scans.size());
    });
    EXPECT_EQ(refusal(file), scans.size() <= 100 ? "none" : "a.jpg: JPEG cannot be read: it has more than 100 scans");
  }
}

}  // namespace
}  // namespace facemap
