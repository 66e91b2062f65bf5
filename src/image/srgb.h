#pragma once

#include <facemap/color.h>

#include <cstddef>
#include <cstdint>

namespace facemap {

/// Color::to_24_bit for `count` colours: three bytes each, red first.
void encode_srgb(const Color* colors, std::size_t count, std::uint8_t* bytes);

/// The same with levels in proportion to light.
void encode_linear(const Color* colors, std::size_t count, std::uint8_t* bytes);

/// IEC 61966-2-1: the linear value of an encoded one in 0..1.
double linear_from_srgb(double encoded);

/// IEC 61966-2-1: the encoded value of a linear one in 0..1; relative error below 2^-45.
double srgb_from_linear(double linear);

}  // namespace facemap
