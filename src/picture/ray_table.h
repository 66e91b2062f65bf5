#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "picture/sample_grid.h"
#include "simd/seen_planes.h"

namespace facemap {

/// What the rays of a grid share: for a projection the map coordinates of its columns and rows, and the frame; for
/// other lenses a table of all directions.
struct RayTable {
  explicit RayTable(const SampleGrid& grid);

  /// Fills batch.direction. `samples`: numbers in the grid; map_x and map_y of the batch must be set.
  void find_directions(const std::uint32_t* samples, simd::RayBatch& batch) const;

  simd::RayFrame frame{};                            ///< of a projection
  std::vector<double> columns;                       ///< texels to the right of the map's centre
  std::vector<double> rows;                          ///< texels above it
  std::shared_ptr<const DirectionTable> directions;  ///< null for a projection
};

}  // namespace facemap
