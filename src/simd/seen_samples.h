#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/seen_rays.h"

namespace facemap::simd {

/// The faces that samples of a picture see, row by row, -1: none, from the first sample of a tile on.
struct TileFaces {
  const std::int32_t* faces;
  std::size_t stride;           ///< from one row to the next
  std::uint32_t first_sample;   ///< number in the picture
  const double *map_x, *map_y;  ///< of the columns and the rows, from the tile's first
};

/// What is known of samples that see a face: arrays with room for kSeenBatch.
struct SampleLists {
  std::uint32_t *samples, *faces;
  double *map_x, *map_y;
};

/// Lists the samples of a tile that see a face: blocks of kRunColumns x kRunRows, column of blocks by column, each row
/// by row. `columns` must be a multiple of kRunColumns, columns x rows at most kSeenBatch. Returns how many.
inline constexpr int kRunColumns = 8, kRunRows = 2;
std::size_t list_samples(const TileFaces& tile, int columns, int rows, const SampleLists& lists);

}  // namespace facemap::simd
