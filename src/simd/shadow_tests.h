#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/shadow_frame.h"
#include "simd/shadow_planes.h"
#include "simd/shadow_points.h"

namespace facemap::simd {

/// Greater than any bound of a face's w.
inline constexpr float kAllBlocked = 0x1p127f;

/// Points of a light, sorted by texel, row by row.
struct SortedPoints {
  const ShadowBlock* blocks;
  const std::uint32_t* begins;  ///< of each texel its first point, by place in the blocks; one more at the end
  float* farthest;              ///< least w of a block; kAllBlocked once all its points are blocked
  std::uint16_t* blocked;       ///< one bit a point
  ShadowRaster raster;
};

/// Sixteen faces with the texels they may block points in; first > last in `rows`: none.
struct ShadowBatch {
  const ShadowPlanes* planes;
  const std::uint32_t* face;
  const std::int32_t* columns;  ///< first | last << 16
  const std::int32_t* rows;     ///< first | last << 16
  const float* nearest;
  const std::int8_t* sides;
};

/// A point, by place, about which float32 can't say whether the face blocks it.
struct UndecidedPair {
  std::uint32_t place;
  std::uint32_t face;
  std::int8_t side;
};

/// Blocks of points to be held against faces of a batch: block << 4 | face.
using ShadowJobs = std::vector<std::uint32_t>;

/// Sets the bit of each point that a face of the batch surely blocks, and appends the pairs that are left open.
/// Returns how many pairs were decided, counting sixteen for each block. The same on every target, in the same order.
std::uint64_t test_points(const ShadowBatch& batch, SortedPoints& points, ShadowJobs& jobs,
                          std::vector<UndecidedPair>& undecided);

}  // namespace facemap::simd
