#include "render/filtered_rows.h"

#include <algorithm>

namespace facemap {

FilteredRows::FilteredRows(const PixelFilter& filter, int width, int height)
    : filter_(filter), width_(width), height_(height) {
  for (int x = 0; x < width; ++x) columns_.push_back(filter_.window(x, width));
}

void FilteredRows::add(int count, const std::vector<Color>& samples, const Executor& executor, Color* pixels) {
  const auto columns = static_cast<std::size_t>(width_ * filter_.per_side());
  add(
      count, [&](int row, Color*) { return samples.data() + static_cast<std::size_t>(row) * columns; }, executor,
      pixels);
}

void FilteredRows::add(int count, const Row& row, const Executor& executor, Color* pixels) {
  const int per_side = filter_.per_side(), first_row = next_row_, end_row = next_row_ + count;
  // Pixel rows that need some of these samples: open ones and those whose window begins above end_row.
  int end = open_from_;
  while (end < height_ && end * per_side + filter_.first() < end_row) ++end;
  open_.resize(static_cast<std::size_t>(end - open_from_));
  std::vector<std::vector<Color>> scratch(static_cast<std::size_t>(executor.threads()));
  executor.for_each(open_.size(), [&](std::size_t i, int worker) {
    const int y = open_from_ + static_cast<int>(i);
    std::vector<Sum>& sums = open_[i];
    std::vector<Color>& space = scratch[static_cast<std::size_t>(worker)];
    sums.resize(static_cast<std::size_t>(width_));
    space.resize(static_cast<std::size_t>(width_ * per_side));
    const PixelFilter::Window window = filter_.window(y, height_);
    const int top = y * per_side + filter_.first();
    const int last = std::min(top + window.end, end_row);
    for (int j = std::max(top + window.begin, first_row); j < last; ++j) {
      add_row(row(j - first_row, space.data()), filter_.weights()[static_cast<std::size_t>(j - top)], sums);
    }
    if (last < top + window.end) return;
    write(y, sums, pixels);
    sums = {};
  });
  int open_from = open_from_;
  while (open_from < end &&
         open_from * per_side + filter_.first() + filter_.window(open_from, height_).end <= end_row) {
    ++open_from;
  }
  open_.erase(open_.begin(), open_.begin() + (open_from - open_from_));
  open_from_ = open_from;
  next_row_ = end_row;
}

void FilteredRows::add_row(const Color* samples, double weight, std::vector<Sum>& sums) const {
  const double* weights = filter_.weights().data();
  for (int x = 0; x < width_; ++x) {
    const PixelFilter::Window& window = columns_[static_cast<std::size_t>(x)];
    const int first = x * filter_.per_side() + filter_.first();
    Sum of_row;
    for (int k = window.begin; k < window.end; ++k) {
      const Color& color = samples[first + k];
      of_row.r += weights[k] * color.r;
      of_row.g += weights[k] * color.g;
      of_row.b += weights[k] * color.b;
    }
    Sum& sum = sums[static_cast<std::size_t>(x)];
    sum.r += weight * of_row.r;
    sum.g += weight * of_row.g;
    sum.b += weight * of_row.b;
  }
}

void FilteredRows::write(int y, const std::vector<Sum>& sums, Color* pixels) const {
  const double rows = filter_.window(y, height_).sum;
  for (int x = 0; x < width_; ++x) {
    const auto i = static_cast<std::size_t>(x);
    const double weight = rows * columns_[i].sum;
    pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + i] = {
        static_cast<float>(sums[i].r / weight), static_cast<float>(sums[i].g / weight),
        static_cast<float>(sums[i].b / weight)};
  }
}

}  // namespace facemap
