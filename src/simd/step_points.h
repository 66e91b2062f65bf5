#pragma once

#include <cstddef>
#include <cstdint>

namespace facemap::simd {

/// The box of points. If one is not finite, what it says of the others is of no meaning.
struct PointBox {
  float lower[3], upper[3];
  bool is_finite;
};

/// Of points side by side, three floats each; at least one.
PointBox box_of_points(const float* points, std::size_t count);

/// Steps from an origin: (p - origin) * per_step, which is within 2^30 of 0, rounded to nearest, ties to even.
struct PointSteps {
  double origin[3];
  double per_step;
};

/// Writes the steps of points, three floats each, to x, y and z.
void step_points(const float* points, std::size_t count, const PointSteps& steps, std::int32_t* x, std::int32_t* y,
                 std::int32_t* z);

}  // namespace facemap::simd
