#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/hub_planes.h"

namespace facemap::simd {

/// How a hub sees segments' ends: on the six sides of a cube about it, side 2 axis + (1 if against the axis). On a
/// side's square, texels x texels large, a direction D w is at its components along the next two axes.
struct HubRaster {
  int texels;
  const std::uint32_t* begins;  ///< of each texel the first place of its segments, which are sorted; and one more
  const std::uint32_t* counts;  ///< of each side, (texels + 1)^2: how many are in the texels before a column and a row
};

inline constexpr int kHubSides = 6;

/// The texel of each of `count` segments, (side texels + row) texels + column. Room for sixteen more.
void find_hub_texels(const HubTargets& targets, std::size_t count, int texels, std::uint32_t* to);

/// Boxes of sixteen packs of faces: coordinate i.
struct alignas(64) PackBoxes {
  static constexpr std::size_t kPacks = 16;
  float lower[3][kPacks];
  float upper[3][kPacks];
};

/// Where a hub sees a box on one side.
struct HubBox {
  std::uint32_t pack;  ///< of the sixteen
  std::uint32_t side;
  std::int32_t column, last_column, row, last_row;
  float u0, u1, v0, v1;
  float w;  ///< no face in it blocks a segment of a greater w
};

/// Writes what sixteen boxes are on the sides where there are segments behind them, at most six each, packs in order.
/// Returns how many.
std::size_t sift_boxes(const PackBoxes& boxes, const float* hub, const HubRaster& raster, HubBox* to);

/// Writes the places of the segments that the box may hide. Returns how many. Room for sixteen more.
std::size_t find_behind(const HubBox& box, const HubRaster& raster, const HubTargets& targets, std::uint32_t* places);

}  // namespace facemap::simd
