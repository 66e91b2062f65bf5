#pragma once

#include <facemap/color.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "parallel/executor.h"
#include "render/picture_pieces.h"
#include "render/pixel_filter.h"

namespace facemap {

/// Makes pixels of rows of samples that come from the top down, in bands of any height. Each pixel's sum is taken in
/// one order, row by row and from left to right, so that it does not depend on the bands or the threads.
class FilteredRows {
 public:
  /// Of a picture of `width` x `height` pixels. Samples of another piece of it do not count for a pixel.
  FilteredRows(const PixelFilter& filter, int width, int height, const PicturePieces& pieces = {});

  /// The samples of a row of the band, 0 being its first; it may be written to `scratch` (a row's length).
  using Row = std::function<const Color*(int row, Color* scratch)>;

  /// Adds the next `count` rows of samples and writes the pixels that are complete with them to their places in
  /// `pixels`, the whole picture.
  void add(int count, const std::vector<Color>& samples, const Executor& executor, Color* pixels);
  void add(int count, const Row& row, const Executor& executor, Color* pixels);

 private:
  struct Sum {
    double r = 0, g = 0, b = 0;
  };

  void add_row(const Color* samples, double weight, std::vector<Sum>& sums) const;
  void write(int y, const std::vector<Sum>& sums, Color* pixels) const;

  const PixelFilter filter_;
  const int width_, height_;
  std::vector<PixelFilter::Window> columns_, rows_;
  std::vector<std::vector<Sum>> open_;  // sums of pixel rows open_from_ and below, which wait for more samples
  int open_from_ = 0, next_row_ = 0;
};

}  // namespace facemap
