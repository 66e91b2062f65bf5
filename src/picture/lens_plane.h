#pragma once

#include <facemap/vector.h>

#include <array>

#include "picture/lens_tiles.h"
#include "picture/tile_plane.h"

namespace facemap {

/// Rows of blocks of a tile's raster.
inline constexpr std::uint32_t kLensRowSamples = TilePlane::kLargestTile / simd::kBlockSide * simd::kBlockSamples;

/// Sets the plane's points to the directions of a tile that is not empty.
void set_plane(const SampleGrid& grid, const LensTiles::Tile& tile, double unit, TilePlane& plane);

/// Which columns and rows of a tile a face may cover: both are near linear functions of the place on the tile's plane.
class TileBoxes {
 public:
  TileBoxes(const LensTiles::Tile& tile, const TilePlane& plane);

  /// A face's corners less the camera's position, world units.
  using Offsets = std::array<DVector, 3>;

  /// False if the face covers no sample.
  bool find(const Offsets& corners, TileFace& face) const;

 private:
  struct Fit {
    double u = 0, v = 0, constant = 0;
    double margin = 0;  // samples
    int last = 0;

    double at(double x, double y) const { return u * x + v * y + constant; }
  };
  void set_margin(const LensTiles::Tile& tile, bool of_columns, Fit& fit) const;

  const TilePlane& plane_;
  Fit column_, row_;
  bool is_known_ = false;
};

}  // namespace facemap
