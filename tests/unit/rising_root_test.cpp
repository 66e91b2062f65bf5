#include "math/rising_root.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using facemap::rising_root;
using facemap::ValueAndSlope;

TEST(RisingRoot, IsRightToTheLastBits) {
  for (double target = 1e-12; target < 1e12; target *= 7.3) {
    const auto f = [&](double x) { return ValueAndSlope{x * x * x - target, 3 * x * x}; };
    EXPECT_NEAR(rising_root(f, 0, 1e6, target) / std::cbrt(target), 1, 0x1p-51) << target;
  }
}

TEST(RisingRoot, HalvesWhereThereIsNoSlope) {
  int calls = 0;
  for (const double slope : {1e-300, 0.0, std::nan("")}) {
    const auto f = [&](double x) { return ++calls, ValueAndSlope{x - 0.7, slope}; };
    EXPECT_NEAR(rising_root(f, 0, 1, 0.2), 0.7, 0x1p-51) << slope;
  }
  EXPECT_LT(calls, 1000);
}

TEST(RisingRoot, FindsAJump) {
  const auto f = [](double x) { return ValueAndSlope{x < 0.3 ? -1.0 : 1.0, 0.0}; };
  EXPECT_NEAR(rising_root(f, 0, 1, 0.5), 0.3, 0x1p-52);
}

TEST(RisingRoot, FindsRootsAtTheEndsOfTheBracket) {
  const auto f = [](double x) { return ValueAndSlope{x - 1, 1}; };
  EXPECT_NEAR(rising_root(f, 0, 1, 0.5), 1, 0x1p-52);
  EXPECT_NEAR(rising_root(f, 1, 2, 1.5), 1, 0x1p-51);
}

}  // namespace
