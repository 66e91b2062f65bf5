#include "picture/point_projection.h"

#include <algorithm>

namespace facemap {
namespace {

// Points with a lesser Z (the farthest have about 1) are left out whatever their error: w stays a normal float.
constexpr double kLeastZ = 0x1p-60;

}  // namespace

simd::PointTransform PointProjection::through(const simd::ShadowFrame& frame, double slack) const {
  simd::PointTransform transform{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      transform.matrix[i][k] = frame.rows[i][k] * points.step;
      transform.offset[i] += frame.rows[i][k] * from_light[k];
    }
  }
  transform.nearest = static_cast<float>(std::max(error_in(frame) * 0x1p24 / slack, kLeastZ) * (1 + 0x1p-20));
  return transform;
}

simd::PointsToProject PointProjection::onto(const simd::ShadowFrame& frame, double slack, const std::uint8_t* wanted,
                                            std::uint8_t bit) const {
  return {through(frame, slack), points.x.data(), points.y.data(), points.z.data(), wanted, bit, points.size()};
}

}  // namespace facemap
