#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "picture/sample_grid.h"
#include "simd/nearest_target.h"

namespace facemap {

/// Where a raster's first sample stands in the picture.
struct RasterPlace {
  int first_column = 0, first_row = 0;
};

/// Draws what waits, and decides the contests of a raster exactly. Afterwards target.faces holds the nearest faces of
/// all its samples where target.w is above 0; the contested ones whose hit is tied or not strictly inside are appended
/// to `loose`, by their numbers in the picture, in no order. Returns how many samples were contested.
std::size_t resolve_contests(const Scene& scene, const SampleGrid& grid, const RasterPlace& place,
                             const simd::RasterTarget& target, std::vector<std::uint32_t>& loose, Counters* counters);

}  // namespace facemap
