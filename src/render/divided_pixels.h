#pragma once

#include <facemap/color.h>
#include <facemap/face.h>

#include <cstdint>
#include <span>
#include <vector>

#include "parallel/executor.h"
#include "picture/sample_grid.h"
#include "render/edge_pixels.h"
#include "render/pixel_filter.h"

namespace facemap {

/// Puts the samples of divided pixels together with the one sample of the others.
class DividedPixels {
 public:
  /// `pixels`: the picture of one sample a pixel, which becomes that of all samples. All must outlive
  /// this.
  DividedPixels(const PixelFilter& filter, bool is_box, const EdgePixels& edges, std::span<Color> pixels);

  /// Takes samples of a band whose first pixel is number `first`: their colours, of those that see a face.
  void take(std::size_t first, const DividedPlaces& places, std::span<const std::uint32_t> samples,
            std::span<const Color> colors, const Color& background);

  /// Once all are taken.
  void finish(const Executor& executor);

  std::uint64_t count() const { return count_; }

 private:
  const Color* row_of_samples(int row, Color* scratch) const;

  const PixelFilter filter_;
  const bool is_box_;
  const EdgePixels& edges_;
  const std::span<Color> pixels_;
  std::uint64_t count_ = 0;
  std::vector<std::uint32_t> numbers_;  // 0: not divided, n: its samples begin at (n - 1) * their number in a pixel
  std::vector<Color> samples_;
};

}  // namespace facemap
