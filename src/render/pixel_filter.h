#pragma once

#include <facemap/renderer.h>

#include <vector>

namespace facemap {

/// How much the samples about a pixel count for its colour: the same along x and along y, and for every pixel but for
/// samples that would lie outside the picture, or in another piece of it, which are left out.
class PixelFilter {
 public:
  /// `width`: of the window, in pixels, of the Blackman-Harris filter; a box is one pixel wide.
  PixelFilter(Renderer::Filter filter, double width, int per_side);

  /// Samples of the row (or column) of pixels that count for pixel 0: from `first`, below 0 where the window reaches
  /// into the pixel's neighbours, as many as there are weights.
  int first() const { return first_; }
  const std::vector<double>& weights() const { return weights_; }  ///< their sum is 1

  int per_side() const { return per_side_; }

  /// Pixels on either side whose samples count.
  int reach() const { return (-first_ + per_side_ - 1) / per_side_; }

  /// The places in weights() of the samples that are inside the picture (or piece), for one of its `pixels` columns or
  /// rows: weights [begin, end), and their sum.
  struct Window {
    int begin, end;
    double sum;
  };
  Window window(int pixel, int pixels) const;

 private:
  int per_side_;
  int first_ = 0;
  std::vector<double> weights_;
};

/// The 4-term Blackman-Harris window at `place` from its middle, in window widths; 0 outside -1/2..1/2.
double blackman_harris(double place);

}  // namespace facemap
