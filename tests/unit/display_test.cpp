// Exposure, curve and transfer of a picture on its way to levels.

#include <facemap/error.h>
#include <facemap/image_file.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "image/filmic.h"

namespace facemap {
namespace {

using Curve = DisplayTransform::Curve;

Image picture_of(std::vector<Color> pixels) {
  Image image;
  image.width = static_cast<int>(pixels.size());
  image.height = 1;
  image.pixels = std::move(pixels);
  return image;
}

Image grey_ramp(int count, float step) {
  std::vector<Color> pixels;
  for (int i = 0; i < count; ++i) {
    const float light = static_cast<float>(i) * step;
    pixels.push_back({light, light, light});
  }
  return picture_of(std::move(pixels));
}

TEST(Display, WholeStopsDoubleAndHalveExactly) {
  const Image image = picture_of({{0.1f, 1.0f / 3, 7}, {0, 1e-3f, 0.75f}});
  for (int stops = -20; stops <= 20; ++stops) {
    const Image shown = displayed(image, {static_cast<double>(stops)});
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      EXPECT_EQ(shown.pixels[i].r, std::ldexp(image.pixels[i].r, stops));
      EXPECT_EQ(shown.pixels[i].g, std::ldexp(image.pixels[i].g, stops));
      EXPECT_EQ(shown.pixels[i].b, std::ldexp(image.pixels[i].b, stops));
    }
  }
  EXPECT_FLOAT_EQ(displayed(image, {0.5}).pixels[0].b, 7 * std::sqrt(2.0f));
  EXPECT_FLOAT_EQ(displayed(image, {-1.5}).pixels[0].b, 7 / std::sqrt(8.0f));
}

TEST(Display, FilmicCurveHasThePublishedValues) {
  constexpr double kRounding = 0x1p-48;  // of a quotient of two sums of two terms
  EXPECT_EQ(filmic(0), 0);
  EXPECT_NEAR(filmic(1), 2.54 / 3.16, kRounding);
  EXPECT_NEAR(filmic(0.5), 0.6425 / 1.0425, kRounding);
  EXPECT_NEAR(filmic(0.18), 0.086724 / 0.324932, kRounding);
  EXPECT_EQ(filmic(8), 1);
  EXPECT_EQ(filmic(std::numeric_limits<double>::infinity()), 1);
  EXPECT_EQ(filmic(-1), 0);
  EXPECT_EQ(filmic(std::nan("")), 0);
}

TEST(Display, MoreLightIsNeverDarker) {
  const Image ramp = grey_ramp(1 << 16, 0x1p-13f);
  for (const DisplayTransform& display : {DisplayTransform{-2.3, Curve::Filmic}, DisplayTransform{1, Curve::Filmic},
                                          DisplayTransform{0.7, Curve::None}}) {
    const Image shown = displayed(ramp, display);
    for (std::size_t i = 1; i < shown.pixels.size(); ++i) ASSERT_GE(shown.pixels[i].g, shown.pixels[i - 1].g);
  }
}

TEST(Display, ThreadsChangeNothing) {
  const Image ramp = grey_ramp(100'000, 1e-4f);
  const DisplayTransform display{0.3, Curve::Filmic};
  const Image shown = displayed(ramp, display, 1);
  for (const int threads : {2, 3}) EXPECT_TRUE(displayed(ramp, display, threads).pixels == shown.pixels);
}

TEST(Display, ExposureOutOfRangeIsAnError) {
  const Image image = picture_of({{1, 1, 1}});
  for (const double stops : {64.5, -65.0, std::nan("")}) EXPECT_THROW(displayed(image, {stops}), Error) << stops;
  EXPECT_TRUE(std::isfinite(displayed(image, {64}).pixels[0].r));
}

TEST(Display, PngIsWrittenAsItIsShown) {
  const Image image = grey_ramp(300, 0.01f);
  EXPECT_EQ(encode_png(image), encode_png(image, 1, DisplayTransform{}));
  const DisplayTransform display{-1, Curve::Filmic};
  EXPECT_EQ(encode_png(image, 1, display), encode_png(displayed(image, display)));
  EXPECT_NE(encode_png(image, 1, display), encode_png(image));
}

TEST(Display, LinearLevelsAreInProportion) {
  const Image image = picture_of({{0, 0.5f, 1}, {0.25f, 2, -1}, {std::nanf(""), 0.2f, 0.001f}});
  EXPECT_EQ(levels_8(image, Transfer::Linear), (std::vector<std::uint8_t>{0, 128, 255, 64, 255, 0, 0, 51, 0}));
  const std::vector<std::uint8_t> file = encode_png(image, 1, {0, Curve::None, Transfer::Linear});
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  EXPECT_NE(text.find(std::string_view("gAMA\x00\x01\x86\xa0", 8)), text.npos);  // 100000
  EXPECT_EQ(text.find("sRGB"), text.npos);
}

}  // namespace
}  // namespace facemap
