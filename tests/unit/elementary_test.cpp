#include "math/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace {

namespace own = facemap::elementary;

TEST(Elementary, SineAndCosineKeepTheirBound) {
  for (int i = -200000; i <= 200000; ++i) {
    const double x = i * 3.7e-4;
    ASSERT_LE(std::fabs(own::sin(x) - std::sin(x)), own::kAngleError) << x;
    ASSERT_LE(std::fabs(own::cos(x) - std::cos(x)), own::kAngleError) << x;
  }
  for (double x : {1e5, -3e5, 1048576.0}) EXPECT_LE(std::fabs(own::sin(x) - std::sin(x)), own::kAngleError) << x;
  EXPECT_TRUE(std::isnan(own::sin(INFINITY)));
  EXPECT_TRUE(std::isnan(own::cos(2e6)));
}

TEST(Elementary, SineIsRelativelyExactNearZero) {
  for (double x = 1e-300; x < 0.1; x *= 3.0) EXPECT_NEAR(own::sin(x) / std::sin(x), 1.0, 0x1p-51) << x;
}

TEST(Elementary, ArcTangentKeepsItsBoundInEveryQuadrant) {
  for (int i = 0; i < 300000; ++i) {
    const double angle = i * 2.1e-5 - 3.15;
    const double y = std::sin(angle) * (1 + i % 7), x = std::cos(angle) * (1 + i % 7);
    ASSERT_LE(std::fabs(own::atan2(y, x) - std::atan2(y, x)), own::kAngleError) << angle;
  }
  EXPECT_EQ(own::atan2(0, 0), 0);
  EXPECT_EQ(own::atan2(0, -1), own::kPi);
  for (double t = 1e-200; t < 1e-3; t *= 7) EXPECT_NEAR(own::atan2(t, 1) / t, std::atan(t) / t, 0x1p-50);
}

TEST(Elementary, ArcSineAndArcCosineKeepTheirBound) {
  for (int i = -100000; i <= 100000; ++i) {
    const double x = i * 1e-5;
    ASSERT_LE(std::fabs(own::asin(x) - std::asin(x)), own::kAngleError) << x;
    ASSERT_LE(std::fabs(own::acos(x) - std::acos(x)), own::kAngleError) << x;
  }
  EXPECT_EQ(own::asin(1.5), own::asin(1.0));
}

TEST(Elementary, ExponentialLogarithmAndPowerKeepTheirBounds) {
  for (int i = -60000; i <= 60000; ++i) {
    const double x = i * 0.0117;
    ASSERT_NEAR(own::exp(x) / std::exp(x), 1.0, 0x1p-50) << x;
  }
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    ASSERT_LE(std::fabs(own::log(x) - std::log(x)), 0x1p-50 * (std::fabs(std::log(x)) + 1)) << x;
  }
  for (int i = 1; i < 100000; ++i) {
    const double x = i * 1e-5;
    ASSERT_NEAR(own::pow(x, 1 / 2.4) / std::pow(x, 1 / 2.4), 1.0, 0x1p-46) << x;
  }
  EXPECT_EQ(own::pow(0, 2), 0);
  EXPECT_EQ(own::exp(-1000), 0);
}

TEST(Elementary, ArcTangentOfWhatHasNoAngleIsNaN) {
  for (const auto& [y, x] :
       {std::pair{NAN, 1.0}, {1.0, NAN}, {NAN, NAN}, {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, HUGE_VAL}}) {
    EXPECT_TRUE(std::isnan(own::atan2(y, x))) << y << ' ' << x;
  }
}

}  // namespace
