#pragma once

#include <facemap/color.h>

#include <cstddef>
#include <cstdint>

namespace facemap {

/// Color::to_24_bit for `count` colours: three bytes each, red first.
void encode_srgb(const Color* colors, std::size_t count, std::uint8_t* bytes);

}  // namespace facemap
