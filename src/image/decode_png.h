#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/decode_image.h"

namespace facemap {

bool is_png(std::span<const std::uint8_t> bytes) noexcept;
bool is_png_16(std::span<const std::uint8_t> bytes) noexcept;  ///< of 16 bits a channel

/// See decode_image().
DecodedImage decode_png(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels);

/// The same with all bits of a PNG of 16; a level of fewer bits is spread over 0..65535.
struct DecodedImage16 {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> rgba;  ///< rows from the top
};
DecodedImage16 decode_png_16(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels);

}  // namespace facemap
