#include "render/filtered_rows.h"

#include <algorithm>

namespace facemap {
namespace {

// Of each of `pixels` columns or rows that lie in pieces of so many; number 0 is the picture's number `first`.
std::vector<PixelFilter::Window> windows_of(const PixelFilter& filter, int pixels, int first, int piece) {
  std::vector<PixelFilter::Window> windows;
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const int piece_begin = (first + pixel) / piece * piece - first;
    const int begin = std::max(0, piece_begin), end = std::min(pixels, piece_begin + piece);
    windows.push_back(filter.window(pixel - begin, end - begin));
  }
  return windows;
}

}  // namespace

FilteredRows::FilteredRows(const PixelFilter& filter, int width, int height, const PicturePieces& pieces)
    : filter_(filter),
      width_(width),
      height_(height),
      columns_(windows_of(filter, width, pieces.first_column, pieces.width)),
      rows_(windows_of(filter, height, pieces.first_row, pieces.height)) {}

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
    const PixelFilter::Window& window = rows_[static_cast<std::size_t>(y)];
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
         open_from * per_side + filter_.first() + rows_[static_cast<std::size_t>(open_from)].end <= end_row) {
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
  const double rows = rows_[static_cast<std::size_t>(y)].sum;
  for (int x = 0; x < width_; ++x) {
    const auto i = static_cast<std::size_t>(x);
    const double weight = rows * columns_[i].sum;
    pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + i] = {
        static_cast<float>(sums[i].r / weight), static_cast<float>(sums[i].g / weight),
        static_cast<float>(sums[i].b / weight)};
  }
}

}  // namespace facemap
