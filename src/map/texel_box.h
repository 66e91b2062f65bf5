#pragma once

#include <facemap/projection.h>

#include <algorithm>
#include <cmath>

namespace facemap {

/// Columns x0..x1 and rows y0..y1 of texels, both ends inside; they may lie outside the raster.
struct TexelBox {
  int x0, y0, x1, y1;

  bool is_empty() const { return x0 > x1 || y0 > y1; }

  TexelBox clipped(const Projection& projection) const {
    return {std::max(x0, 0), std::max(y0, 0), std::min(x1, projection.width() - 1),
            std::min(y1, projection.height() - 1)};
  }
};

/// The box of three map points, `margin` texels larger on each side.
inline TexelBox box_around(const MapPoint (&corners)[3], double margin) {
  const auto texel = [](double coordinate) {
    constexpr double kFar = 1 << 20;  // texels: beyond any raster, within an int
    return static_cast<int>(std::floor(std::clamp(coordinate, -kFar, kFar)));
  };
  const double x0 = std::min({corners[0].x, corners[1].x, corners[2].x});
  const double y0 = std::min({corners[0].y, corners[1].y, corners[2].y});
  const double x1 = std::max({corners[0].x, corners[1].x, corners[2].x});
  const double y1 = std::max({corners[0].y, corners[1].y, corners[2].y});
  return TexelBox{texel(x0 - margin), texel(y0 - margin), texel(x1 + margin), texel(y1 + margin)};
}

}  // namespace facemap
