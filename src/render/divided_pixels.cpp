#include "render/divided_pixels.h"

#include <algorithm>

#include "render/filtered_rows.h"

namespace facemap {
namespace {

Color mean(std::span<const Color> colors) {
  double r = 0, g = 0, b = 0;
  for (const Color& color : colors) {
    r += color.r;
    g += color.g;
    b += color.b;
  }
  const auto count = static_cast<double>(colors.size());
  return {static_cast<float>(r / count), static_cast<float>(g / count), static_cast<float>(b / count)};
}

}  // namespace

DividedPixels::DividedPixels(const PixelFilter& filter, bool is_box, const EdgePixels& edges, std::span<Color> pixels)
    : filter_(filter), is_box_(is_box), edges_(edges), pixels_(pixels) {
  if (!is_box) numbers_.resize(pixels.size());
}

// The mean in the order of rows and columns, as of a picture whose pixels are all divided.
void DividedPixels::take(std::size_t first, const DividedPlaces& places, std::span<const std::uint32_t> samples,
                         std::span<const Color> colors, const Color& background) {
  const std::size_t in_pixel = places.in_pixel();
  std::vector<Color> of_all(places.count(), background);
  for (std::size_t i = 0; i < samples.size(); ++i) of_all[places.place(samples[i])] = colors[i];
  count_ += places.pixels.size();
  for (std::size_t i = 0; i < places.pixels.size(); ++i) {
    const std::size_t pixel = first + places.pixels[i];
    if (is_box_) {
      pixels_[pixel] = mean(std::span(of_all).subspan(i * in_pixel, in_pixel));
    } else {
      numbers_[pixel] = static_cast<std::uint32_t>(samples_.size() / in_pixel + i + 1);
    }
  }
  if (!is_box_) samples_.insert(samples_.end(), of_all.begin(), of_all.end());
}

void DividedPixels::finish(const Executor& executor) {
  if (is_box_) return;
  const int height = static_cast<int>(pixels_.size() / static_cast<std::size_t>(edges_.width()));
  std::vector<Color> filtered(pixels_.size());
  FilteredRows(filter_, edges_.width(), height, edges_.pieces())
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
