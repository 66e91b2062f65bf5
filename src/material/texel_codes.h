#pragma once

#include <cstdint>
#include <vector>

namespace facemap {

/// What the 256 values of a colour channel stand for, 0..1: sRGB in linear light, or plain numbers.
const float* linear_values(bool is_srgb);

/// Four channels a texel, 0..1 and linear, as bytes, rounded to the nearest; the fourth is always a plain number.
std::vector<std::uint8_t> encoded(const std::vector<float>& values, bool is_srgb);

}  // namespace facemap
