#pragma once

#include <facemap/face.h>
#include <facemap/renderer.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "facemap_bench_cases.h"

namespace facemap::bench {

constexpr int kTile = 32;   // samples a side of a tile
constexpr int kBlock = 16;  // samples of a 4 x 4 block, the largest packet

/// The float32 directions of a picture's rays, the ones that FaceMap asks about, tile by tile and in each tile 4 x 4
/// block by block: 16 x, 16 y, 16 z. They are made before the clock starts, which is to the opponent's advantage.
class Rays {
 public:
  Rays(const View& view, int columns, int rows, int samples);

  int columns() const noexcept { return columns_; }
  int rows() const noexcept { return rows_; }
  int tiles_across() const noexcept { return (columns_ + kTile - 1) / kTile; }
  int tile_count() const noexcept { return tiles_across() * ((rows_ + kTile - 1) / kTile); }
  const Vector& origin() const noexcept { return origin_; }

  /// kTile * kTile * 3 floats; outside the picture and where the projection has no direction they are 0.
  const float* tile(int number) const { return directions_.data() + std::size_t(number) * kTile * kTile * 3; }

 private:
  int columns_, rows_;
  Vector origin_;
  std::vector<float> directions_;
};

/// Column and row within a tile of the tile's i-th sample, block by block.
struct InTile {
  int column, row;
};
constexpr InTile place_in_tile(int i) {
  const int block = i / kBlock, lane = i % kBlock, across = kTile / 4;
  return {block % across * 4 + lane % 4, block / across * 4 + lane / 4};
}

/// Face ids and light masks, row by row, as facemap::Image has them.
struct Answer {
  int columns = 0, rows = 0;
  int light_count = 0;
  std::unique_ptr<FaceId[]> ids;
  std::unique_ptr<std::uint8_t[]> lights;

  Answer(int columns, int rows, int light_count);
  int light_bytes() const { return (light_count + 7) / 8; }
  std::size_t count() const { return std::size_t(columns) * std::size_t(rows); }
};

/// Milliseconds of the phases: seeing, what is made of the geometry before lights can be asked, asking them.
struct Phases {
  double camera = 0, build = 0, shade = 0, total = 0;
};

/// Where two answers are not the same.
struct Difference {
  std::size_t samples = 0;         ///< all
  std::size_t ids = 0;             ///< samples that see different faces
  std::size_t queries = 0;         ///< lights asked about samples that see the same face
  std::size_t bits = 0;            ///< of those, answered otherwise
  std::vector<std::size_t> where;  ///< the samples in question, of either kind
};
Difference compare(const Image& ours, const Answer& theirs);

}  // namespace facemap::bench
