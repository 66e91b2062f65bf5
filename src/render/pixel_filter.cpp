#include "render/pixel_filter.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace facemap {

// F. J. Harris, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform", Proc. IEEE 66(1),
// 1978, table I: the minimum 4-term window (side lobes of -92 dB).
double blackman_harris(double place) {
  if (!(std::abs(place) < 0.5)) return 0;
  const double x = 2 * elementary::kPi * (place + 0.5);
  return 0.35875 - 0.48829 * elementary::cos(x) + 0.14128 * elementary::cos(2 * x) - 0.01168 * elementary::cos(3 * x);
}

PixelFilter::PixelFilter(Renderer::Filter filter, double width, int per_side) : per_side_(per_side) {
  if (filter == Renderer::Filter::Box) {
    weights_.assign(static_cast<std::size_t>(per_side), 1.0 / per_side);
    return;
  }
  // Sample k lies (k + 1/2) / per_side - 1/2 pixels from the middle of pixel 0. Twice that, in samples, is a whole
  // number, so that both sides get the same bits.
  const auto weight = [&](int k) { return blackman_harris(std::abs(2 * k + 1 - per_side) / (2.0 * per_side * width)); };
  const int middle = per_side / 2;
  first_ = middle;
  while (weight(first_ - 1) > 0) --first_;
  for (int k = first_; k <= per_side - 1 - first_; ++k) weights_.push_back(weight(k));
  double sum = 0;
  for (const double w : weights_) sum += w;
  // A window narrower than the samples' distance has none in an even pixel: the nearest ones share it.
  if (!(sum > 0)) {
    first_ = (per_side - 1) / 2;
    weights_.assign(static_cast<std::size_t>(per_side - 2 * first_), 1.0);
    sum = static_cast<double>(weights_.size());
  }
  for (double& w : weights_) w /= sum;
}

PixelFilter::Window PixelFilter::window(int pixel, int pixels) const {
  const int first = pixel * per_side_ + first_, count = static_cast<int>(weights_.size());
  Window window{std::max(0, -first), std::min(count, pixels * per_side_ - first), 0};
  for (int k = window.begin; k < window.end; ++k) window.sum += weights_[static_cast<std::size_t>(k)];
  return window;
}

}  // namespace facemap
