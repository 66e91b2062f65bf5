#pragma once

#include <facemap/compare.h>

#include <cstdint>
#include <span>
#include <string>

namespace facemap {

bool is_pfm(std::span<const std::uint8_t> bytes) noexcept;

/// "PF" (R, G, B) or "Pf" (Y), of either byte order; the scale counts for its sign alone. Throws LoadError.
PictureChannels decode_pfm(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels);

}  // namespace facemap
