#pragma once

#include <algorithm>
#include <cmath>

namespace facemap {

struct ValueAndSlope {
  double value, slope;
};

/// Where a continuous function changes from below 0 to not below 0 between `low` and `high`, to the last bits: Newton's
/// steps from `guess` as long as they stay within the bracket, then halving, which always ends. `function(x)` gives
/// ValueAndSlope; where the slope is 0 or not a number the bracket is halved.
template <class Function>
double rising_root(const Function& function, double low, double high, double guess) {
  constexpr int kNewtonSteps = 32;  // doubles need six near a simple root, some more to come near it
  // A step doubles the digits: after one of this share of x the rest is below 2^-60 x^2 f"/(2 f').
  constexpr double kLastStep = 0x1p-30;
  double x = guess >= low && guess <= high ? guess : low + 0.5 * (high - low);
  for (int step = 0;; ++step) {
    const ValueAndSlope f = function(x);
    (f.value < 0 ? low : high) = x;
    double next = x - f.value / f.slope;
    if (std::fabs(next - x) <= kLastStep * std::fabs(x)) return std::clamp(next, low, high);
    if (!(step < kNewtonSteps && next >= low && next <= high)) {
      next = low + 0.5 * (high - low);
      if (!(next > low && next < high)) return x;
    }
    x = next;
  }
}

}  // namespace facemap
