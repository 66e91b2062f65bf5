#pragma once

#include <facemap/vector.h>

#include <optional>

#include "simd/shadow_frame.h"

namespace facemap {

/// Where points lie from a light: a box about their offsets from it, world units.
struct OffsetBox {
  DVector lower, upper;
};

/// The frame in which the box fills the raster, if the light sees all of it well in front of itself. `error`: of a
/// point in the box, world units.
std::optional<simd::ShadowFrame> frame_towards(const Vector& light, const OffsetBox& box, double error);

/// The same frame turned by a quarter about its axis: u takes the place of v.
simd::ShadowFrame turned(const simd::ShadowFrame& frame);

/// The frame that looks along axis side / 2, against it if side is odd (0..5), and holds each offset of which that is
/// the greatest component, up to rounding, as long as it is at most `reach`.
simd::ShadowFrame frame_of_side(const Vector& light, int side, double reach);

}  // namespace facemap
