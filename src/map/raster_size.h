#pragma once

#include <cstddef>

namespace facemap {

/// Texels a side of a light's map of so many faces: about one a face.
inline int texels_for(std::size_t faces) {
  constexpr int kFewest = 64, kMost = 2048;
  int texels = kFewest;
  while (texels < kMost && static_cast<double>(texels) * texels < static_cast<double>(faces)) texels *= 2;
  return texels;
}

/// A raster is at most so many times as wide as high, or as high as wide.
inline constexpr double kMostOblong = 8;

}  // namespace facemap
