#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/face_kernels.h"

/// Points about a map's origin, projected many at a time: the same bits as one by one (FaceMap::texel_of).
namespace facemap::simd {

/// A plane projection about a point, as Projection and SpaceVector have it.
struct PlaneMap {
  double origin[3];
  double axis_x[3], axis_y[3], axis_z[3];
  double texel_angle, width, height;
};

/// What is asked of kChunk points or fewer. Arrays are read and written up to kChunk.
struct PointChunk {
  alignas(64) float x[kChunk], y[kChunk], z[kChunk];                        ///< world coordinates, finite
  alignas(64) double offset_x[kChunk], offset_y[kChunk], offset_z[kChunk];  ///< from the origin, world units
  alignas(64) double length[kChunk];                                        ///< of the offset, map units
  alignas(64) float D_x[kChunk], D_y[kChunk], D_z[kChunk];                  ///< the offset rounded, map units
  alignas(64) std::int32_t texel[kChunk];  ///< row * width + column; negative outside the raster
};

/// Offsets, lengths and D of all points; `scale` is map units a world unit.
void find_offsets(const double origin[3], double scale, PointChunk& chunk);

/// Texels of all points from their offsets.
void find_texels(const PlaneMap& map, PointChunk& chunk);

}  // namespace facemap::simd
