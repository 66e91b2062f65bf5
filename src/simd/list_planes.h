#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/face_kernels.h"

/// What a map knows of each face, set up for sixteen faces at a time in double precision.
namespace facemap::simd {

inline constexpr std::size_t kSetupFaces = 16;

/// The corners of sixteen faces: coordinate i of corner k.
struct alignas(64) SetupCorners {
  float of[3][3][kSetupFaces];
};

/// FacePlanes by component, for faces turned away: for the others all planes and offsets change their sign.
struct alignas(64) SetupPlanes {
  float x[4][kSetupFaces], y[4][kSetupFaces], z[4][kSetupFaces];
  float offset[kSetupFaces], error[kSetupFaces], offset_error[kSetupFaces];
  double nearest_corner[kSetupFaces];  ///< distance from the origin, world units
  double longest_edge[kSetupFaces];    ///< world units
  double plane_distance[kSetupFaces];  ///< lower bound of the plane's distance from the origin, world units
  std::int8_t side[kSetupFaces];       ///< as facemap::side, or 0 where doubles leave it open
};

/// `scale` is map units a world unit, a power of two.
void set_up_list_planes(const SetupCorners& corners, const float origin[3], double scale, SetupPlanes& planes);

}  // namespace facemap::simd
