#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "picture/ray_table.h"
#include "picture/sample_grid.h"
#include "picture/tile_plane.h"
#include "picture/tile_raster.h"
#include "simd/nearest_boxes.h"
#include "simd/nearest_planes.h"
#include "simd/nearest_tile.h"
#include "simd/nearest_vertices.h"

namespace facemap {

/// A surface projection as the raster's kernels see it: square tiles of samples, each with a plane of its own, and
/// boxes of faces on the curved map.
struct SurfaceView {
  SurfaceView(const Scene& scene, const SampleGrid& grid);

  simd::SurfaceFrame vertices;
  simd::BoxRules boxes;
  double unit = 1;          ///< a power of two that brings the scene's lengths to about 1
  double sample_angle = 0;  ///< radians
  int tile_side = 1;        ///< samples; a power of two, at most TilePlane::kLargestTile
  int tile_columns = 0, tile_rows = 0;
  std::uint32_t row_samples = simd::kBlockSamples;  ///< of a tile's raster, and as many rows of blocks
  simd::PlaneFrame directions;                      ///< (X, Y, Z) in the camera's axes, for set_up_large and find_tiles

  std::size_t samples() const { return std::size_t{row_samples} * row_samples / simd::kBlockSamples; }
};

/// The samples of one tile.
struct SurfaceTile : TileArea {
  bool is_whole = false;  ///< all of them have directions
  bool is_empty = false;  ///< none of them has
};

SurfaceTile tile_of(const SurfaceView& view, const SampleGrid& grid, std::size_t tile);

/// Sets the plane's points to the directions of a tile's samples.
void set_plane(const SurfaceView& view, const SampleGrid& grid, const RayTable& rays, const SurfaceTile& tile,
               TilePlane& plane);

/// Caps of all tiles, in the camera's axes.
class SurfaceCaps {
 public:
  SurfaceCaps(const SurfaceView& view, const SampleGrid& grid);
  simd::TileCaps caps() const { return {x_.data(), y_.data(), z_.data(), sine_.data(), count_}; }

 private:
  std::size_t count_;
  std::vector<float> x_, y_, z_, sine_;
};

}  // namespace facemap
