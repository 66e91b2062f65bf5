#pragma once

#include <cstdint>

namespace facemap {

/// "This face lies in this texel": what a builder produces. A texel is row * width + column.
struct TexelEntry {
  std::uint32_t texel;
  std::uint32_t face;
};

}  // namespace facemap
