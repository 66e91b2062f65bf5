#pragma once

#include <facemap/compare.h>

#include <cstdint>
#include <span>
#include <string>

namespace facemap {

bool is_exr(std::span<const std::uint8_t> bytes) noexcept;

/// All channels of the file's first part: half and float as float, UINT as uint32. Throws LoadError.
PictureChannels decode_exr(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels);

}  // namespace facemap
