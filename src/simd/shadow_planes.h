#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/shadow_frame.h"

namespace facemap::simd {

/// Four planes of each of sixteen faces, for a point (u, v, w) of the raster. Each is divided by the bound of its own
/// error, so that a value above 1 is surely positive and one below -1 surely negative:
///   edge k:  edges[k][0] u + edges[k][1] v + edges[k][2] >= 0 where the ray meets the face,
///   plane:   plane[0] u + plane[1] v + plane[2] - plane[3] w > 0 where the point is beyond the face's plane.
/// Coefficients are 0 where float32 can't hold a plane: always undecided.
struct alignas(64) ShadowPlanes {
  static constexpr std::size_t kFaces = 16;
  float edges[3][3][kFaces];
  float plane[4][kFaces];
};

/// The corners of sixteen faces: coordinate i of corner k.
struct alignas(64) ShadowCorners {
  float of[3][3][ShadowPlanes::kFaces];
};

/// Side towards the light of each, as facemap::side, or 0 where doubles leave it open: then the planes are those of a
/// face turned away, and plane[] is 0.
///
/// `slack`: how far X, Y or Z of a point may be off, relative to Z, in units of 2^-24.
void set_up_planes(const ShadowFrame& frame, const ShadowCorners* corners, std::size_t groups, double slack,
                   ShadowPlanes* planes, std::int8_t* sides);

}  // namespace facemap::simd
