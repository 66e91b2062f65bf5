#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "picture/shared_pages.h"
#include "simd/nearest_target.h"

namespace facemap {

/// Memory of a raster of `columns` x `rows` samples in which nothing is drawn yet.
class BlockRaster {
 public:
  BlockRaster(int columns, int rows)
      : row_samples_(spread((columns + simd::kBlockSide - 1) / simd::kBlockSide) * simd::kBlockSamples),
        count_(std::size_t{row_samples_} * static_cast<std::size_t>((rows + simd::kBlockSide - 1) / simd::kBlockSide)),
        memory_(std::make_shared<SharedPages>(room_for_depths() + SharedPages::room_for<std::int32_t>(count_))) {
    w_ = memory_->take<float>(room_for_depths() / sizeof(float));
    faces_ = memory_->take<std::int32_t>(count_);
  }

  /// The raster's memory, for other use: it is gone then.
  std::shared_ptr<SharedPages> release() {
    memory_->take_back();
    return std::move(memory_);
  }

  simd::RasterTarget target(int first_row, int last_row, simd::Contests* contests, simd::Fragments* fragments) const {
    return {w_, faces_, row_samples_, first_row, last_row, contests, fragments};
  }

 private:
  // A block's w is a cache line, and so are its faces. Lines whose addresses are equal in their low 12 bits get into
  // each other's way.
  static constexpr std::uint32_t kLines = 64, kNarrow = 16;

  // Up to the faces, which begin half of those bits' range after the depths.
  std::size_t room_for_depths() const {
    constexpr std::size_t kLine = 64, kRange = kLines * kLine;
    return (count_ * sizeof(float) + kRange - 1) / kRange * kRange + (kLines / 2 + 1) * kLine;
  }

  // At least `blocks`, such that blocks less than 6 rows and columns of each other differ in those bits.
  static std::uint32_t spread(int blocks) {
    constexpr std::uint32_t kNear = 6;
    const auto is_spread = [](std::uint32_t stride) {
      for (std::uint32_t row = 1; row < kNear; ++row) {
        const std::uint32_t line = stride * row % kLines;
        if (line < kNear || line > kLines - kNear) return false;
      }
      return true;
    };
    auto stride = static_cast<std::uint32_t>(blocks);
    while (stride > kNarrow && !is_spread(stride)) ++stride;
    return stride;
  }

  std::uint32_t row_samples_;
  std::size_t count_;
  std::shared_ptr<SharedPages> memory_;
  float* w_;
  std::int32_t* faces_;
};

}  // namespace facemap
