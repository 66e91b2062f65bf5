#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/nearest_planes.h"
#include "simd/nearest_target.h"

namespace facemap::simd {

/// The directions of a tile's samples, numbered as in its raster: points (u, v) of the plane that a PlaneFrame
/// means, NaN where there is none.
struct TilePoints {
  const float *u, *v;
};

/// Points of `count` directions (a multiple of kBlockFaces) on the plane about axes[2], per_radian samples a radian: of
/// d, ((axes[0] . d), (axes[1] . d)) * per_radian / (axes[2] . d) in double, rounded to float32. Returns the greatest
/// |u| or |v|.
double find_tile_points(const double axes[3][3], double per_radian, const float* x, const float* y, const float* z,
                        std::size_t count, float* u, float* v);

/// Draws faces over boxes of a tile, 16 in lanes, one sample each at a time. Unsure faces are passed over.
void draw_tile_faces(const FaceBlock& block, const FaceBoxes& boxes, const TilePoints& points,
                     const RasterTarget& target);

/// Draws face `k` of a block over its box, neighbouring samples in lanes.
void draw_tile_face(const FaceBlock& block, const FaceBoxes& boxes, std::size_t k, const TilePoints& points,
                    const RasterTarget& target);

/// Caps that hold the directions of tiles: unit vectors of their centres and sines of their angular radii (less than
/// 90 degrees), rounded up.
struct TileCaps {
  const float *x, *y, *z, *sine;
  std::size_t count;
};

/// Appends to `tiles` (room for caps.count + kBlockFaces) those whose cap may meet the face; returns how many. `face`:
/// set up for directions of unit length in the caps' axes.
std::size_t find_tiles(const LargeFace& face, const TileCaps& caps, std::uint32_t* tiles);

}  // namespace facemap::simd
