#pragma once

#include <cstdint>

namespace facemap {

/// "This face lies in this texel": what a builder produces. A texel is row * width + column.
struct TexelEntry {
  std::uint32_t texel;
  std::uint32_t face;
  float nearest = 0;  ///< the face's lower bound of distance, by which lists are ordered; not negative
};

}  // namespace facemap
