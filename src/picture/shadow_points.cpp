#include "picture/shadow_points.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "scene/reserve_pages.h"

namespace facemap {
namespace {

using simd::FarthestPyramid;
using simd::ShadowBlock;

// Vectors of the kernels may read and write this many elements past what they use.
constexpr std::size_t kPadding = 64;

constexpr int kMostColumns = 1024;
constexpr int kMostRows = 512;

// Spots are worth marking where there are this many faces a point: most faces then have no point in their box.
constexpr std::size_t kFacesPerPointForSpots = 2;

template <class T>
void make_room(std::vector<T>& v, std::size_t count) {
  if (v.size() >= count) return;
  v.clear();  // nothing to be copied
  reserve_pages(v, count);
  v.resize(count);
}

template <class T>
std::size_t bytes_of(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

// About two points a texel, four times as many columns as rows: a row of a face is one run of points.
simd::ShadowRaster raster_for(std::size_t points) {
  simd::ShadowRaster raster{16, 8};
  const auto texels = [&] { return static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows); };
  while (2 * texels() < points && raster.rows < kMostRows) {
    if (raster.columns < kMostColumns && raster.columns < 4 * raster.rows) {
      raster.columns *= 2;
    } else {
      raster.rows *= 2;
    }
  }
  return raster;
}

}  // namespace

void ShadowPoints::sort(const simd::PointsToProject& from, std::size_t wanted, std::size_t faces,
                        std::vector<std::uint32_t>& rest) {
  raster_ = raster_for(wanted);
  has_spots_ = faces > kFacesPerPointForSpots * wanted;
  count_texels(from, rest);
  fill_blocks(from);
  build_pyramid();
}

void ShadowPoints::count_texels(const simd::PointsToProject& from, std::vector<std::uint32_t>& rest) {
  const std::size_t texels = texel_count();
  begins_.assign(texels + 1 + kPadding, 0);
  if (has_spots_) occupied_.assign(texels * simd::kSpotColumns * simd::kSpotRows / 8 + kPadding, 0);
  std::uint32_t* begins = begins_.data();
  count_ = simd::count_points(from, raster_, begins, has_spots_ ? occupied_.data() : nullptr, rest);
  std::uint32_t sum = 0;
  for (std::size_t t = 0; t <= texels; ++t) {
    const std::uint32_t count = begins[t];
    begins[t] = sum;
    sum += count;
  }
}

void ShadowPoints::fill_blocks(const simd::PointsToProject& from) {
  block_count_ = (count_ + ShadowBlock::kPoints - 1) / ShadowBlock::kPoints;
  make_room(blocks_, block_count_);
  make_room(farthest_of_block_, block_count_ + kPadding);
  make_room(point_of_place_, count_);
  blocked_.assign(block_count_ + kPadding, 0);

  auto* records = reinterpret_cast<std::byte*>(blocks_.data());
  simd::place_points(from, raster_, begins_.data(), records, point_of_place_.data());
  // Each texel's begin has moved to the next one's.
  std::memmove(begins_.data() + 1, begins_.data(), texel_count() * sizeof(begins_[0]));
  begins_[0] = 0;

  // The last block's spare places hold points that every face is behind, and are blocked from the start.
  for (std::size_t place = count_; place < block_count_ * ShadowBlock::kPoints; ++place) {
    const simd::ShadowRecord behind{0, 0, 0x1p100f, 0};
    std::memcpy(records + place * sizeof(behind), &behind, sizeof(behind));
    set_blocked(static_cast<std::uint32_t>(place));
  }
  simd::finish_blocks(blocks_.data(), block_count_, farthest_of_block_.data());
}

void ShadowPoints::build_pyramid() {
  int columns = std::max(1, raster_.columns >> FarthestPyramid::kCellColumnsLog2);
  int rows = std::max(1, raster_.rows >> FarthestPyramid::kCellRowsLog2);
  const int cell_columns = raster_.columns / columns, cell_rows = raster_.rows / rows;
  cells_.assign(2 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + kPadding,
                std::numeric_limits<float>::infinity());
  pyramid_ = {};
  pyramid_.cells = cells_.data();

  // A cell's row is a run of points; its blocks may hold neighbours too, which only lowers the least w.
  for (int y = 0; y < raster_.rows; ++y) {
    float* cell = cells_.data() + static_cast<std::size_t>(y / cell_rows) * static_cast<std::size_t>(columns);
    const std::uint32_t* begins =
        begins_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.columns);
    for (int x = 0; x < columns; ++x, ++cell) {
      const std::uint32_t begin = begins[x * cell_columns], end = begins[(x + 1) * cell_columns];
      for (std::uint32_t place = begin; place < end; place = (place / 16 + 1) * 16) {
        *cell = std::min(*cell, farthest_of_block_[place / 16]);
      }
    }
  }

  std::int32_t first = 0;
  while (true) {
    pyramid_.first[pyramid_.levels] = first;
    pyramid_.columns[pyramid_.levels] = columns;
    ++pyramid_.levels;
    if ((columns == 1 && rows == 1) || pyramid_.levels == FarthestPyramid::kLevels) break;
    const float* below = cells_.data() + first;
    const int columns_below = columns, rows_below = rows;
    first += columns * rows;
    columns = std::max(1, columns / 2);
    rows = std::max(1, rows / 2);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const int x0 = std::min(2 * x, columns_below - 1), x1 = std::min(2 * x + 1, columns_below - 1);
        const int y0 = std::min(2 * y, rows_below - 1), y1 = std::min(2 * y + 1, rows_below - 1);
        cells_[static_cast<std::size_t>(first + y * columns + x)] =
            std::min(std::min(below[y0 * columns_below + x0], below[y0 * columns_below + x1]),
                     std::min(below[y1 * columns_below + x0], below[y1 * columns_below + x1]));
      }
    }
  }
}

simd::SortedPoints ShadowPoints::sorted() noexcept {
  return {blocks_.data(), begins_.data(), farthest_of_block_.data(), blocked_.data(), raster_};
}

std::size_t ShadowPoints::memory_bytes() const noexcept {
  return bytes_of(point_of_place_) + bytes_of(begins_) + bytes_of(blocks_) + bytes_of(farthest_of_block_) +
         bytes_of(blocked_) + bytes_of(cells_) + bytes_of(occupied_);
}

}  // namespace facemap
