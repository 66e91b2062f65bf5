#include <facemap/image_file.h>
#include <gtest/gtest.h>

#include <string_view>

#include "image/decode_png.h"
#include "support/planes.h"

namespace facemap {
namespace {

constexpr std::uint64_t kMaxPixels = 1 << 22;

/// RGBA of a plane of 1 to 4 channels.
std::vector<std::uint16_t> rgba_of(const TestPlane<std::uint16_t>& plane) {
  std::vector<std::uint16_t> rgba;
  for (int i = 0; i < plane.width * plane.height; ++i) {
    const std::uint16_t* const pixel = plane.values.data() + i * plane.channels;
    const bool is_grey = plane.channels < 3, has_alpha = plane.channels % 2 == 0;
    for (int k = 0; k < 3; ++k) rgba.push_back(pixel[is_grey ? 0 : k]);
    rgba.push_back(has_alpha ? pixel[plane.channels - 1] : 65535);
  }
  return rgba;
}

TEST(Png16, ReadsBackWhatItWrote) {
  for (const int channels : {1, 2, 3, 4}) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 7), std::pair(257, 64)}) {
      const TestPlane<std::uint16_t> plane(width, height, channels);
      const DecodedImage16 image = decode_png_16(encode_png_16(plane.view(), Transfer::Srgb), "a.png", kMaxPixels);
      ASSERT_EQ(image.width, width);
      ASSERT_EQ(image.height, height);
      EXPECT_EQ(image.rgba, rgba_of(plane)) << channels << " channels, " << width << 'x' << height;
    }
  }
}

TEST(Png16, BytesDoNotDependOnThreads) {
  TestPlane<std::uint16_t> plane(701, 903, 3);
  for (std::size_t i = 0; i < plane.values.size(); ++i) {
    plane.values[i] = static_cast<std::uint16_t>(i / 3 + plane.values[i] % 4);  // something to compress
  }
  const std::vector<std::uint8_t> bytes = encode_png_16(plane.view(), Transfer::Srgb, 1);
  EXPECT_LT(bytes.size(), plane.values.size());
  for (const int threads : {0, 2, 3}) EXPECT_TRUE(encode_png_16(plane.view(), Transfer::Srgb, threads) == bytes);
  EXPECT_TRUE(decode_png_16(bytes, "a.png", kMaxPixels).rgba == rgba_of(plane));
}

TEST(Png16, SaysHowItsLevelsStandForLight) {
  const TestPlane<std::uint16_t> plane(4, 4, 3);
  const auto has = [&](Transfer transfer, std::string_view text) {
    const std::vector<std::uint8_t> bytes = encode_png_16(plane.view(), transfer);
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).find(text) != text.npos;
  };
  const std::string_view gamma("gAMA\x00\x01\x86\xa0", 8);  // 100000
  EXPECT_TRUE(has(Transfer::Srgb, "sRGB"));
  EXPECT_FALSE(has(Transfer::Srgb, "gAMA"));
  EXPECT_TRUE(has(Transfer::Linear, gamma));
  EXPECT_FALSE(has(Transfer::Linear, "sRGB"));
}

TEST(Png16, RefusesOtherPlanes) {
  const auto refusal = [](const PlaneView& plane) { return error_of([&] { encode_png_16(plane, Transfer::Srgb); }); };
  const TestPlane<std::uint16_t> plane(4, 4, 3);
  const TestPlane<std::uint8_t> bytes(4, 4, 3);
  EXPECT_EQ(refusal({4, 4, 5, std::span<const std::uint16_t>()}), "PNG: the plane has other values than it says");
  EXPECT_EQ(refusal({0, 4, 3, std::span<const std::uint16_t>()}), "PNG: the image has no pixels");
  EXPECT_EQ(refusal(TestPlane<std::uint16_t>(4, 4, 5).view()), "PNG: the format has no 5 channels");
  EXPECT_EQ(refusal(bytes.view()), "PNG: the plane is of another type than the format has");
}

}  // namespace
}  // namespace facemap
