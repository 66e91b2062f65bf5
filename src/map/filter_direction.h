#pragma once

#include <facemap/vector.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace facemap {

/// A direction as the float32 filter takes it: scaled by a power of two to a length in [1, 4), exact, or off by less
/// than the filter's underflow.
struct FilterDirection {
  float d[3];
  float length;  ///< upper bound

  explicit FilterDirection(const Vector& v) {
    const float largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    const auto exponent = std::bit_cast<std::uint64_t>(static_cast<double>(largest)) >> 52;
    const double scale = std::bit_cast<double>((2046 - exponent) << 52);
    for (int i = 0; i < 3; ++i) d[i] = static_cast<float>(v[i] * scale);
    length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * (1 + 0x1p-20f);
  }
};

}  // namespace facemap
