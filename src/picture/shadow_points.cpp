#include "picture/shadow_points.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "picture/bytes_of.h"

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

// Bytes of a raster's spots.
std::size_t spot_bytes(std::size_t texels) { return texels * simd::kSpotColumns * simd::kSpotRows / 8 + kPadding; }

bool wants_spots(std::size_t points, std::size_t faces) { return faces > kFacesPerPointForSpots * points; }

std::size_t blocks_for(std::size_t points) { return (points + ShadowBlock::kPoints - 1) / ShadowBlock::kPoints; }

}  // namespace

std::size_t ShadowPoints::bytes_for(std::size_t count, std::size_t faces) {
  const simd::ShadowRaster raster = raster_for(count);
  const std::size_t texels = static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows);
  const std::size_t blocks = blocks_for(count);
  return 2 * SharedPages::room_for<std::uint32_t>(count + simd::kListPadding) +
         SharedPages::room_for<std::uint32_t>(texels + 1 + kPadding) +
         (wants_spots(count, faces) ? SharedPages::room_for<std::uint8_t>(spot_bytes(texels)) : 0) +
         SharedPages::room_for<ShadowBlock>(blocks) + SharedPages::room_for<float>(blocks + kPadding) +
         SharedPages::room_for<std::uint32_t>(count);
}

void ShadowPoints::sort(const simd::ListedPoints& list, const simd::PointTransform& transform,
                        const std::uint32_t* own_faces, std::size_t faces, WorkingMemory& memory,
                        std::vector<std::uint32_t>& rest) {
  raster_ = raster_for(list.count);
  const std::size_t texels = texel_count();
  begins_ = memory.take<std::uint32_t>(texels + 1 + kPadding);
  std::fill_n(begins_, texels + 1 + kPadding, 0);
  occupied_ = nullptr;
  if (wants_spots(list.count, faces)) {
    occupied_ = memory.take<std::uint8_t>(spot_bytes(texels));
    std::fill_n(occupied_, spot_bytes(texels), std::uint8_t{0});
  }
  fill_blocks(project(list, transform, memory, rest), own_faces, memory);
  build_pyramid();
}

simd::ProjectedPoints ShadowPoints::project(const simd::ListedPoints& list, const simd::PointTransform& transform,
                                            WorkingMemory& memory, std::vector<std::uint32_t>& rest) {
  auto* const texels = memory.take<std::uint32_t>(list.count + simd::kListPadding);
  auto* const ranks = memory.take<std::uint32_t>(list.count + simd::kListPadding);
  const auto points = simd::project_points(list, transform, raster_, texels, ranks, {begins_, occupied_}, rest);
  std::uint32_t sum = 0;
  for (std::size_t t = 0; t <= texel_count(); ++t) {
    const std::uint32_t count = begins_[t];
    begins_[t] = sum;
    sum += count;
  }
  return points;
}

void ShadowPoints::fill_blocks(const simd::ProjectedPoints& points, const std::uint32_t* own_faces,
                               WorkingMemory& memory) {
  count_ = points.count;
  block_count_ = blocks_for(count_);
  blocks_ = memory.take<ShadowBlock>(block_count_);
  farthest_of_block_ = memory.take<float>(block_count_ + kPadding);
  point_of_place_ = memory.take<std::uint32_t>(count_);
  blocked_.assign(block_count_ + kPadding, 0);

  auto* records = reinterpret_cast<std::byte*>(blocks_);
  simd::place_points(points, own_faces, begins_, {records, point_of_place_});
  // The last block's spare places hold points that every face is behind, and are blocked from the start.
  for (std::size_t place = count_; place < block_count_ * ShadowBlock::kPoints; ++place) {
    const simd::ShadowRecord behind{0, 0, 0x1p100f, 0};
    std::memcpy(records + place * sizeof(behind), &behind, sizeof(behind));
    set_blocked(static_cast<std::uint32_t>(place));
  }
  simd::finish_blocks(blocks_, block_count_, farthest_of_block_);
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
    const std::uint32_t* begins = begins_ + static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.columns);
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
  return {blocks_, begins_, farthest_of_block_, blocked_.data(), raster_};
}

std::size_t ShadowPoints::memory_bytes() const noexcept { return bytes_of(blocked_) + bytes_of(cells_); }

}  // namespace facemap
