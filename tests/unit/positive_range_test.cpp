#include "math/positive_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/random.h"

namespace {

using facemap::positive_range;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double range_of(const std::vector<double>& coefficients) { return positive_range(coefficients); }

TEST(PositiveRange, EndsAtTheLeastRoot) {
  EXPECT_NEAR(range_of({1, -1}), 1, 1e-12);
  EXPECT_NEAR(range_of({6, -11, 6, -1}), 1, 1e-10);  // (1 - x)(2 - x)(3 - x)
  EXPECT_NEAR(range_of({1, 0, -0.3}), std::sqrt(1 / 0.3), 1e-10);
  EXPECT_NEAR(range_of({1, 0, 0, 0, -1e-4}), 10, 1e-6);
  EXPECT_NEAR(range_of({1, -1e3}), 1e-3, 1e-12);
}

TEST(PositiveRange, IsNotAboveTheRoot) {
  Random random(71);
  for (int i = 0; i < 2000; ++i) {
    const double root = std::exp(random.between(-6.0, 6.0)), a = random.between(0.0, 3.0), b = random.between(0.0, 3.0);
    // (root - x)(1 + a x + b x^2)
    EXPECT_LE(range_of({root, root * a - 1, root * b - a, -b}), root) << root << ' ' << a << ' ' << b;
  }
}

TEST(PositiveRange, IsInfiniteWithoutARoot) {
  EXPECT_EQ(range_of({1}), kInfinity);
  EXPECT_EQ(range_of({2, 0, 0, 0}), kInfinity);
  EXPECT_EQ(range_of({1, 3, 5}), kInfinity);
  EXPECT_EQ(range_of({1, -1, 1}), kInfinity);
}

TEST(PositiveRange, ADoubleRootEndsIt) {
  EXPECT_NEAR(range_of({4, -4, 1}), 2, 1e-5);  // (2 - x)^2: what is below 2^-42 of 4 (1 + x)^2 counts as a root
  EXPECT_LE(range_of({4, -4, 1}), 2);
}

TEST(PositiveRange, IsZeroForWhatIsNotPositiveAtZero) {
  EXPECT_EQ(range_of({0, 1}), 0);
  EXPECT_EQ(range_of({-1}), 0);
  EXPECT_EQ(range_of({1, std::nan("")}), 0);
  EXPECT_EQ(range_of({1, kInfinity}), 0);
}

}  // namespace
