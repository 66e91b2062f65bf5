#pragma once

#include <algorithm>
#include <cstddef>

#include "picture/face_texels.h"
#include "simd/bounded_points.h"

namespace facemap {

/// Which spots of a texel a face may meet: one bit each, row by row.
class FaceSpots {
 public:
  /// `fine`: the face on the raster of spots; `size`: texels a side.
  FaceSpots(const FaceTexels& fine, int size) : fine_(fine), size_(static_cast<std::size_t>(size)) {}

  /// Quickest if the last texel asked about is in the same row.
  unsigned in(std::size_t texel) {
    const int row = static_cast<int>(texel / size_), column = kSpots * static_cast<int>(texel % size_);
    if (row != row_) {
      row_ = row;
      for (int k = 0; k < kSpots; ++k) spans_[k] = fine_.columns_in(kSpots * row + k);
    }
    unsigned spots = 0;
    for (int k = 0; k < kSpots; ++k) {
      const int first = std::max(spans_[k].first - column, 0), last = std::min(spans_[k].last - column, kSpots - 1);
      if (first <= last) spots |= ((2u << last) - (1u << first)) << (kSpots * k);
    }
    return spots;
  }

 private:
  static constexpr int kSpots = simd::kTexelSpots;

  const FaceTexels fine_;
  const std::size_t size_;
  int row_ = -1;
  FaceTexels::Span spans_[kSpots];  // of the row's spots
};

}  // namespace facemap
