#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "picture/sample_grid.h"
#include "simd/nearest_target.h"

namespace facemap {

/// Decides the contests of a raster exactly and sorts them. Afterwards target.faces holds the nearest faces of all
/// samples; the contested ones whose hit is tied or not strictly inside are appended to `loose`, ascending.
void resolve_contests(const Scene& scene, const SampleGrid& grid, const simd::RasterTarget& target,
                      std::vector<std::uint32_t>& loose, Counters* counters);

}  // namespace facemap
