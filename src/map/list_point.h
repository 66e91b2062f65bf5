#pragma once

#include <cmath>

#include "map/texels.h"
#include "math/dvector.h"
#include "simd/face_kernels.h"

namespace facemap {

/// The point O + D as the filter on lists takes it; `length` is that of D, both in map units.
inline simd::ListPoint list_point(const DVector& D, double length) {
  simd::ListPoint point;
  for (int i = 0; i < 3; ++i) point.D[i] = static_cast<float>(D[i]);
  point.length = static_cast<float>(length * (1 + 0x1p-20));
  point.reach = static_cast<float>(length * (1.0 + Texels::kDepthMargin));
  return point;
}

/// Whether a point may lie beyond the cut of its texel, behind which the texel's list is not complete.
inline bool is_beyond(double length, float cut) { return length > cut * (1.0 + Texels::kDepthMargin); }

}  // namespace facemap
