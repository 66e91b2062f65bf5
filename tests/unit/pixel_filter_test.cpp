// Weights of samples, and pixels made of rows of them.

#include "render/pixel_filter.h"

#include <facemap/error.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/filtered_rows.h"

namespace facemap {
namespace {

using Filter = Renderer::Filter;

// A sum of at most 256 weights of 1 in all, each rounded.
constexpr double kSumError = 256 * 0x1p-53;

TEST(PixelFilter, WindowHasTheTabledValues) {
  // 0.35875 - 0.48829 cos x + 0.14128 cos 2x - 0.01168 cos 3x at x = pi, pi / 2 and pi / 3.
  constexpr double kRounding = 0x1p-47;  // of four terms and of cosines (elementary::kAngleError)
  EXPECT_NEAR(blackman_harris(0), 1, kRounding);
  EXPECT_NEAR(blackman_harris(0.25), 0.35875 - 0.14128, kRounding);
  EXPECT_NEAR(blackman_harris(-0.25), 0.35875 - 0.14128, kRounding);
  EXPECT_NEAR(blackman_harris(1.0 / 6 - 0.5), 0.35875 - 0.48829 / 2 - 0.14128 / 2 + 0.01168, kRounding);
  EXPECT_EQ(blackman_harris(0.5), 0);
  EXPECT_EQ(blackman_harris(-0.75), 0);
}

TEST(PixelFilter, WeightsAreSymmetricAndAddUpToOne) {
  for (const double width : {0.01, 0.5, 1.0, 1.5, 2.0, 16.0}) {
    for (int per_side = 1; per_side <= 16; ++per_side) {
      const PixelFilter filter(Filter::BlackmanHarris, width, per_side);
      const std::vector<double>& weights = filter.weights();
      ASSERT_EQ(2 * filter.first() + static_cast<int>(weights.size()), per_side);  // about the pixel's middle
      double sum = 0;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        EXPECT_GT(weights[k], 0);
        EXPECT_EQ(weights[k], weights[weights.size() - 1 - k]);
        if (2 * k + 2 < weights.size()) {
          EXPECT_LT(weights[k], weights[k + 1]);
        }
        sum += weights[k];
      }
      EXPECT_NEAR(sum, 1, kSumError) << width << " " << per_side;
    }
  }
}

TEST(PixelFilter, ReachesAsFarAsItsWindow) {
  const PixelFilter filter(Filter::BlackmanHarris, 1.5, 4);  // samples at 1/8, 3/8, 5/8 of a pixel from its middle
  EXPECT_EQ(filter.first(), -1);
  EXPECT_EQ(filter.weights().size(), 6u);
  EXPECT_EQ(filter.reach(), 1);
  EXPECT_EQ(PixelFilter(Filter::Box, 1.5, 4).reach(), 0);
  EXPECT_EQ(PixelFilter(Filter::BlackmanHarris, 1.5, 1).weights(), std::vector<double>(1, 1.0));
  EXPECT_EQ(PixelFilter(Filter::BlackmanHarris, 16, 1).reach(), 7);
}

std::vector<Color> filtered(const PixelFilter& filter, int width, int height, const std::vector<Color>& samples,
                            int rows_at_a_time, int threads) {
  const Executor executor(threads);
  std::vector<Color> pixels(static_cast<std::size_t>(width * height));
  FilteredRows rows(filter, width, height);
  const int columns = width * filter.per_side(), all = height * filter.per_side();
  for (int first = 0; first < all; first += rows_at_a_time) {
    const int count = std::min(rows_at_a_time, all - first);
    rows.add(count, {samples.begin() + first * columns, samples.begin() + (first + count) * columns}, executor,
             pixels.data());
  }
  return pixels;
}

TEST(FilteredRows, AConstantPictureStaysAsItIs) {
  const Color color{0.1f, 1.0f / 3, 123.4f};
  for (const int per_side : {1, 2, 3, 4}) {
    const std::vector<Color> samples(static_cast<std::size_t>(7 * 5 * per_side * per_side), color);
    for (const double width : {0.5, 1.5, 9.0}) {
      const PixelFilter filter(Filter::BlackmanHarris, width, per_side);
      for (const Color& pixel : filtered(filter, 7, 5, samples, per_side, 1)) EXPECT_EQ(pixel, color);
    }
  }
}

TEST(FilteredRows, BandsAndThreadsChangeNothing) {
  constexpr int kWidth = 13, kHeight = 11, kSide = 3;
  std::vector<Color> samples;
  for (int i = 0; i < kWidth * kHeight * kSide * kSide; ++i) {
    samples.push_back(
        {static_cast<float>(i * 37 % 101) / 7, static_cast<float>(i * 53 % 97), 1.0f / static_cast<float>(1 + i % 89)});
  }
  for (const double width : {0.5, 1.5, 2.0, 7.0}) {
    const PixelFilter filter(Filter::BlackmanHarris, width, kSide);
    const std::vector<Color> expected = filtered(filter, kWidth, kHeight, samples, kHeight * kSide, 1);
    for (const int rows : {1, 2, 3, 7, 30}) {
      for (const int threads : {1, 2, 3}) {
        EXPECT_EQ(filtered(filter, kWidth, kHeight, samples, rows, threads), expected) << width << " " << rows;
      }
    }
  }
}

TEST(FilteredRows, AStepRisesFromOneSideToTheOther) {
  constexpr int kWidth = 8, kSide = 4;
  std::vector<Color> samples;
  for (int i = 0; i < kSide * kWidth * kSide; ++i) {
    samples.push_back(i % (kWidth * kSide) < kWidth * kSide / 2 ? Color{0, 0, 0} : Color{1, 1, 1});
  }
  const std::vector<Color> box = filtered(PixelFilter(Filter::Box, 0, kSide), kWidth, 1, samples, kSide, 1);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(box[static_cast<std::size_t>(x)].r, x < kWidth / 2 ? 0 : 1);
  const PixelFilter filter(Filter::BlackmanHarris, 1.5, kSide);
  const std::vector<Color> soft = filtered(filter, kWidth, 1, samples, kSide, 1);
  for (std::size_t x = 1; x < kWidth; ++x) EXPECT_GE(soft[x].r, soft[x - 1].r);
  const auto outermost = static_cast<float>(filter.weights()[0]);  // the one sample beyond the pixel's border
  EXPECT_FLOAT_EQ(soft[kWidth / 2 - 1].r, outermost);
  EXPECT_FLOAT_EQ(soft[kWidth / 2].r, 1 - outermost);
  EXPECT_EQ(soft[kWidth / 2 - 2].r, 0);
  EXPECT_EQ(soft[kWidth / 2 + 1].r, 1);
}

}  // namespace
}  // namespace facemap
