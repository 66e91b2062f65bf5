#pragma once

#include "picture/asked_points.h"
#include "simd/shadow_frame.h"
#include "simd/shadow_points.h"

namespace facemap {

/// Asked points as a frame about a light sees them.
struct PointProjection {
  const AskedPoints& points;
  DVector from_light;  ///< to the points' origin, world units
  double error;        ///< of an offset from the light in each coordinate, world units, the sums included

  /// `size`: bound of |offset|_1 as it is summed. X, Y and Z of a frame are three products and three sums of its rows,
  /// of which no number is greater than frame.largest: 13 roundings of 2^-53 of at most sqrt(3) sizes.
  PointProjection(const AskedPoints& asked, const Vector& light, double size)
      : points(asked), from_light(asked.origin - DVector(light)), error(asked.error + 0x1p-50 * size) {}

  /// How far X, Y and Z may be off.
  double error_in(const simd::ShadowFrame& frame) const { return 2 * frame.largest * error; }

  /// Points with an X, Y or Z that may be off by more than `slack` units of 2^-24 Z are left out.
  simd::PointTransform through(const simd::ShadowFrame& frame, double slack) const;

  /// For kernels; those of `wanted` with `bit`.
  simd::PointsToProject onto(const simd::ShadowFrame& frame, double slack, const std::uint8_t* wanted,
                             std::uint8_t bit) const;
};

}  // namespace facemap
