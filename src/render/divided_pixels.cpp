#include "render/divided_pixels.h"

#include <algorithm>

#include "render/filtered_rows.h"

namespace facemap {

DividedPixels::DividedPixels(const PixelFilter& filter, bool is_box, const EdgePixels& edges, std::span<Color> pixels)
    : filter_(filter), is_box_(is_box), edges_(edges), pixels_(pixels) {
  if (!is_box) numbers_.resize(pixels.size());
}

// The mean in the order of rows and columns, as of a picture whose pixels are all divided.
void DividedPixels::take(const SampleGrid& samples, int rows, std::span<const FaceId> faces,
                         std::span<const Color> colors, const Color& background) {
  const auto columns = static_cast<std::size_t>(samples.columns()), n = static_cast<std::size_t>(samples.per_side);
  const auto width = static_cast<std::size_t>(edges_.width());
  const std::size_t first = edges_.first_pixel(samples);
  const double count = static_cast<double>(n * n);
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows) * width; ++i) {
    if (!edges_.is_divided(first + i)) continue;
    ++count_;
    const std::size_t corner = i / width * n * columns + i % width * n;
    double r = 0, g = 0, b = 0;
    for (std::size_t k = 0; k < n * n; ++k) {
      const std::size_t sample = corner + k / n * columns + k % n;
      const Color& color = faces[sample] == kNoFace ? background : colors[sample];
      if (!is_box_) samples_.push_back(color);
      r += color.r;
      g += color.g;
      b += color.b;
    }
    if (is_box_) {
      pixels_[first + i] = {static_cast<float>(r / count), static_cast<float>(g / count),
                            static_cast<float>(b / count)};
    } else {
      numbers_[first + i] = static_cast<std::uint32_t>(samples_.size() / (n * n));
    }
  }
}

void DividedPixels::finish(const Executor& executor) {
  if (is_box_) return;
  const int height = static_cast<int>(pixels_.size() / static_cast<std::size_t>(edges_.width()));
  std::vector<Color> filtered(pixels_.size());
  FilteredRows(filter_, edges_.width(), height)
      .add(
          height * filter_.per_side(), [&](int row, Color* scratch) { return row_of_samples(row, scratch); }, executor,
          filtered.data());
  std::copy(filtered.begin(), filtered.end(), pixels_.begin());
}

// A pixel that is not divided has as many samples of its colour.
const Color* DividedPixels::row_of_samples(int row, Color* scratch) const {
  const auto n = static_cast<std::size_t>(filter_.per_side()), width = static_cast<std::size_t>(edges_.width());
  const std::size_t first = static_cast<std::size_t>(row) / n * width, in_pixel = static_cast<std::size_t>(row) % n * n;
  for (std::size_t x = 0; x < width; ++x) {
    const std::size_t number = numbers_[first + x];
    if (number == 0) {
      std::fill_n(scratch + x * n, n, pixels_[first + x]);
    } else {
      std::copy_n(samples_.data() + (number - 1) * n * n + in_pixel, n, scratch + x * n);
    }
  }
  return scratch;
}

}  // namespace facemap
