#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <cstdint>
#include <span>
#include <vector>

#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"
#include "picture/tile_plane.h"
#include "simd/nearest_planes.h"
#include "simd/nearest_target.h"

namespace facemap {

/// A face and its box of samples in a tile, both ends inside.
struct TileFace {
  std::uint32_t face;
  std::uint8_t x0, x1, y0, y1;
};

/// The samples of a tile, in their grid.
struct TileArea {
  int first_column = 0, first_row = 0, columns = 0, rows = 0;
};

/// Draws one tile after the other, each by itself. Working memory of one thread.
class TileRaster {
 public:
  /// Tiles of at most side x side samples, in rows of `row_samples` as simd::sample_at has them.
  TileRaster(const Scene& scene, const SampleGrid& grid, const simd::FaceSource& source, int side,
             std::uint32_t row_samples)
      : scene_(scene), grid_(grid), source_(source), side_(side), row_samples_(row_samples) {}

  /// Where the samples of the next tile lie. To be set before draw unless there are no faces.
  TilePlane plane;

  /// Puts the nearest faces of the tile's samples in their places, and appends the numbers of loose ones.
  void draw(const TileArea& tile, std::span<const TileFace> faces, NearestFaces& nearest,
            std::vector<std::uint32_t>& loose, Counters& counters);

 private:
  // Boxes of a tile up to these samples are drawn 16 in lanes, with those of the same class; larger ones alone.
  static constexpr int kClasses = 4;
  static constexpr int kClassSamples[kClasses] = {2, 6, 16, 64};
  static constexpr int kSamples = TilePlane::kLargestTile * TilePlane::kLargestTile;

  /// Faces and boxes that wait to be 16.
  struct Pending {
    std::uint32_t faces[simd::kBlockFaces];
    std::int32_t x0[simd::kBlockFaces], x1[simd::kBlockFaces], y0[simd::kBlockFaces], y1[simd::kBlockFaces];
    std::size_t count = 0;

    void add(const TileFace& f);
    simd::FaceBoxes boxes() const { return {faces, x0, x1, y0, y1, count}; }
  };

  simd::RasterTarget target(int rows) { return {w_, faces_, row_samples_, 0, rows - 1, &contests_, &fragments_}; }
  void add(const TileFace& face);
  void flush(int c);
  void draw_edge_on(const simd::FaceBoxes& boxes, std::size_t k);

  const Scene& scene_;
  const SampleGrid& grid_;
  const simd::FaceSource& source_;
  int side_;
  std::uint32_t row_samples_;
  alignas(64) float w_[kSamples];
  alignas(64) FaceId faces_[kSamples];
  simd::Contests contests_;
  simd::Fragments fragments_;
  Pending pending_[kClasses + 1];
};

}  // namespace facemap
