#include "map/radial_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random.h"

namespace {

using facemap::RadialCurve;
using Terms = std::array<double, RadialCurve::kMostTerms>;

// What RadialCurve bounds, at many places.
double measured_least(const RadialCurve& curve, double bend, double r) {
  double least = 1;
  for (int i = 1; i <= 1000; ++i) {
    const double a = r * i / 1000;
    least = std::min(least, std::min(curve.slope(a), curve.value(a) / a) - 6 * bend * a);
  }
  return least;
}

TEST(RadialCurve, WithoutDistortionIsTheIdentityToItsLimit) {
  const RadialCurve curve({1}, {1}, 0, 8);
  EXPECT_EQ(curve.end(), 8);
  EXPECT_EQ(curve.value(3), 3);
  EXPECT_DOUBLE_EQ(curve.radius(3), 3);
  EXPECT_DOUBLE_EQ(curve.radius(8), 8);
  EXPECT_GT(curve.radius(8.001), 8);
  EXPECT_NEAR(curve.least_slope(8), 1, 0x1p-19);
}

TEST(RadialCurve, EndsWhereItStopsRising) {
  // R = r - 0.1 r^3 falls from sqrt(1/0.3) on; a slope of 2^-10 is 1 - 2^-10 of the way in r^2.
  const RadialCurve curve({1, -0.1}, {1}, 0, 100);
  EXPECT_NEAR(curve.end(), std::sqrt((1 - 0x1p-10) / 0.3), 1e-8);
  EXPECT_LT(curve.value(std::sqrt(1 / 0.3)) - curve.value(curve.end()), 2e-6);
}

TEST(RadialCurve, SlopeIsTheDerivative) {
  const RadialCurve curve({1, 5.2, 2.1, 0.09}, {1, 5.5, 3.4, 0.45}, 0, 10);
  for (double r = 0.1; r < curve.end(); r *= 1.3) {
    EXPECT_NEAR(curve.slope(r), (curve.value(r + 1e-5) - curve.value(r - 1e-5)) / 2e-5, 1e-8) << r;
  }
}

TEST(RadialCurve, RadiusUndoesValueAndLeastSlopeIsNeverPassed) {
  Random random(72);
  for (int i = 0; i < 300; ++i) {
    const auto term = [&](double size) { return random.chance(0.3) ? 0.0 : random.between(-size, size); };
    const Terms n = {1, term(1), term(0.3), term(0.1), term(0.02)};
    const Terms d = {1, std::fabs(term(1)), std::fabs(term(0.3)), term(0.02)};
    const double bend = random.chance(0.5) ? 0 : random.between(0.0, 0.01);
    const RadialCurve curve(n, d, bend, 10);
    ASSERT_GT(curve.end(), 0);
    for (int k = 1; k < 20; ++k) {
      const double r = curve.end() * k / 20;
      const double again = curve.radius(curve.value(r));
      // An error of the value is one of the radius by 1 over the slope.
      EXPECT_NEAR(again, r, 0x1p-48 * (r + curve.magnitude(r) / curve.least_slope(r))) << i << ' ' << k;
      EXPECT_GE(curve.outer_radius(curve.value(r) - 3 * bend * r * r), r);
      EXPECT_GE(measured_least(curve, bend, r), curve.least_slope(r) - 1e-9) << i << ' ' << k;
      EXPECT_LE(std::fabs(curve.value(r)), curve.magnitude(r));
    }
    EXPECT_GE(measured_least(curve, bend, curve.end() * (1 - 1e-6)), RadialCurve::kLeastSlope * (1 - 0x1p-19) - 1e-9);
  }
}

TEST(RadialCurve, LevelsAreAQuarterApart) {
  const RadialCurve curve({1, -0.1}, {1}, 0, 100);
  for (double r = 0.01; r < curve.end(); r += 0.01) {
    EXPECT_GE(curve.least_slope(r), 0.79 * (1 - 0.3 * r * r)) << r;
  }
}

TEST(RadialCurve, HasNoFieldBeyondAPole) {
  // D = 1 - r^2.
  const RadialCurve curve({1}, {1, -1}, 0, 100);
  EXPECT_LT(curve.end(), 1);
  EXPECT_GT(curve.end(), 0.999);
}

TEST(RadialCurve, WildCoefficientsLeaveASmallFieldOrNone) {
  for (const double k : {1e6, -1e6}) {
    const RadialCurve curve({1, k, k, k, k}, {1, k, k, k}, 1e6, 10);
    EXPECT_GE(curve.end(), 0);
    EXPECT_LT(curve.end(), 1e-3);
    EXPECT_GT(curve.radius(1), curve.end());
  }
}

}  // namespace
