#pragma once

#include <bit>
#include <cstdint>

namespace facemap {

/// 2^-k for the k with 2^k <= x < 2^(k+1); 1 for 0. x must be finite, not negative and below 2^1023.
inline double inverse_power_of_two(double x) {
  if (!(x > 0)) return 1;
  return std::bit_cast<double>((2046 - (std::bit_cast<std::uint64_t>(x) >> 52)) << 52);
}

}  // namespace facemap
