#include <facemap/image_file.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

#include "image/decode_jpeg.h"
#include "support/planes.h"

namespace facemap {
namespace {

/// Levels of the largest difference at quality 100: the transform there and back, and two conversions of colour.
constexpr int kRounding = 3;

DecodedImage decode(const std::vector<std::uint8_t>& bytes) { return decode_jpeg(bytes, "a.jpg", 1 << 20); }

TEST(EncodeJpeg, ReadsBackWhatItWroteButForRounding) {
  for (const int channels : {1, 3}) {
    const TestPlane<std::uint8_t> plane(37, 23, channels);  // noise: halved chroma would show
    const DecodedImage image = decode(encode_jpeg(plane.view(), 100));
    ASSERT_EQ(image.width, 37);
    ASSERT_EQ(image.height, 23);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
      const std::size_t channel = i % 4;
      if (channel == 3) continue;
      const std::size_t from = channels == 1 ? i / 4 : 3 * (i / 4) + channel;
      ASSERT_NEAR(image.rgba[i], plane.values[from], kRounding) << i;
    }
  }
}

TEST(EncodeJpeg, GrowsWithQuality) {
  const TestPlane<std::uint8_t> plane(64, 64, 3);
  std::size_t before = 0;
  for (const int quality : {1, 30, 60, 90, 100}) {
    const std::size_t size = encode_jpeg(plane.view(), quality).size();
    EXPECT_GT(size, before) << quality;
    before = size;
  }
}

TEST(EncodeJpeg, HasTheSameBytesWithoutSimd) {
  const TestPlane<std::uint8_t> plane(61, 45, 3);
  const std::vector<std::uint8_t> bytes = encode_jpeg(plane.view(), 85);
  ::setenv("JSIMD_FORCENONE", "1", 1);  // read once a thread
  std::thread([&] { EXPECT_EQ(encode_jpeg(plane.view(), 85), bytes); }).join();
  ::unsetenv("JSIMD_FORCENONE");
}

TEST(EncodeJpeg, RefusesWhatTheFormatHasNot) {
  const auto refusal = [](const PlaneView& plane, int quality) {
    return error_of([&] { encode_jpeg(plane, quality); });
  };
  const TestPlane<std::uint8_t> plane(8, 8, 3);
  EXPECT_EQ(refusal(plane.view(), 0), "JPEG: the quality is not 1 to 100");
  EXPECT_EQ(refusal(plane.view(), 101), "JPEG: the quality is not 1 to 100");
  EXPECT_EQ(refusal(TestPlane<std::uint8_t>(8, 8, 4).view(), 90), "JPEG: the format has no 4 channels");
  EXPECT_EQ(refusal(TestPlane<std::uint8_t>(65501, 1, 1).view(), 90),
            "JPEG: 65501x1 pixels; the format has at most 65500 a side");
  EXPECT_EQ(refusal(TestPlane<std::uint8_t>(65500, 1, 1).view(), 90), "no error");
}

}  // namespace
}  // namespace facemap
