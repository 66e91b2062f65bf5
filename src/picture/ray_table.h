#pragma once

#include <cstdint>
#include <vector>

#include "picture/sample_grid.h"
#include "simd/seen_rays.h"

namespace facemap {

/// What the rays of a grid share: map coordinates of its columns and rows, and the frame.
struct RayTable {
  explicit RayTable(const SampleGrid& grid);

  simd::RayFrame frame;
  std::vector<double> columns;  ///< texels to the right of the map's centre
  std::vector<double> rows;     ///< texels above it
};

}  // namespace facemap
