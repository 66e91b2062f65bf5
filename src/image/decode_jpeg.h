#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "image/decode_image.h"

namespace facemap {

bool is_jpeg(std::span<const std::uint8_t> bytes) noexcept;

/// See decode_image(). The integer transform that is exact to a level, chroma enlarged with a triangle filter: both
/// have the same bits with and without SIMD.
DecodedImage decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels);

}  // namespace facemap
