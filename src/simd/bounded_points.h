#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/shadow_points.h"

namespace facemap::simd {

/// Bounds of w for each texel of a square raster about a light, as numbers: (w - w_least) w_scale, within 0 and kSteps.
/// The upper half of a texel is such that a point of a greater number is lit for certain, and every point if it is 0:
/// nothing stands there. The lower half is such that a point of a lesser number is dark.
struct TexelBounds {
  static constexpr float kSteps = 65535;

  const std::uint32_t* texels;
  int size;  ///< texels a side
  float w_least, w_scale;
};

/// A texel has so many rows and columns of spots.
inline constexpr int kTexelSpotsLog2 = 2, kTexelSpots = 1 << kTexelSpotsLog2;

/// Where on the raster each point lies that is left open. Null: not wanted.
struct OpenPlaces {
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< the texel of a point that has no place

  int size = 0;  ///< texels a side
  std::uint32_t* texels = nullptr;
  std::uint32_t* depths = nullptr;  ///< spot << 16 | the whole part of its number; spot: row * kTexelSpots + column
};

struct PointCounts {
  std::size_t asked = 0, open = 0;
};

/// Of the points first..last-1 that `from` asks for: sets dark[i] to 1 where a point is dark, 0 for all others, and
/// puts the numbers of those that the bounds leave open into `open`, ascending; points off the raster or nearer than
/// from.nearest are among them; `places` has one for each. `first` is a multiple of 64, and so is `last` if it is not
/// from.count. from.wanted need not be readable past its end; `dark` has room for 64 more, `open` and `places` for 16
/// more than are open.
PointCounts decide_points(const PointsToProject& from, const TexelBounds& bounds, std::size_t first, std::size_t last,
                          std::uint8_t* dark, std::uint32_t* open, const OpenPlaces& places = {});

}  // namespace facemap::simd
