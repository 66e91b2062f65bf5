#include "picture/gnomonic.h"

#include <algorithm>
#include <cmath>

#include "math/dvector.h"

namespace facemap {
namespace {

// The raster is this much wider than the points, so that rounding leaves none outside.
constexpr double kRim = 1 + 0x1p-12;

// Half the raster's width over its distance is at least this: beyond, doubles would not tell places on it apart.
constexpr double kNarrowest = 0x1p-26;

// And at least this many errors of a point: else the filter would have to be told of a great error.
constexpr double kLeastSteps = 0x1p25;

// And its width at least this share of its height, and the other way round: the errors of a thin raster are those of a
// long one.
constexpr double kThinnest = 0x1p-8;

// A corner of the box is in front of the light if its direction is within 82 degrees of the axis.
constexpr double kLeastCosine = 0.14;

simd::ShadowFrame make_frame(const Vector& light, const DVector& a, const DVector& b, const DVector& c) {
  simd::ShadowFrame frame{};
  const DVector rows[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      frame.rows[i][k] = rows[i][k];
      frame.largest = std::max(frame.largest, std::fabs(rows[i][k]));
    }
  }
  for (int k = 0; k < 3; ++k) frame.light[k] = light[k];
  return frame;
}

struct Range {
  double lower = HUGE_VAL, upper = -HUGE_VAL;

  void add(double x) {
    lower = std::min(lower, x);
    upper = std::max(upper, x);
  }
  double middle() const { return 0.5 * (lower + upper); }
  double half_width(double least) const { return std::max(0.5 * (upper - lower) * kRim, least); }
};

}  // namespace

std::optional<simd::ShadowFrame> frame_towards(const Vector& light, const OffsetBox& box, double error) {
  const DVector axis = normalized(0.5 * (box.lower + box.upper));
  if (axis == DVector(0)) return {};
  const DVector aside = std::fabs(axis.y) < 0.9 ? DVector(0, 1, 0) : DVector(1, 0, 0);
  const DVector right = normalized(cross(aside, axis)), up = cross(axis, right);

  Range across, along;
  double farthest = 0, nearest = HUGE_VAL;
  for (int k = 0; k < 8; ++k) {
    const DVector corner((k & 1) != 0 ? box.upper.x : box.lower.x, (k & 2) != 0 ? box.upper.y : box.lower.y,
                         (k & 4) != 0 ? box.upper.z : box.lower.z);
    const double depth = dot(corner, axis);
    const double size = std::max({std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z)});
    if (!(depth > kLeastCosine * size * std::sqrt(3.0))) return {};
    farthest = std::max(farthest, depth);
    nearest = std::min(nearest, depth);
    across.add(dot(corner, right) / depth);
    along.add(dot(corner, up) / depth);
  }
  // (right, up, axis) is right-handed, and what follows adds multiples of the axis and scales by positive numbers.
  const double scale = 1 / farthest;
  const double narrowest = std::max(kNarrowest, error / nearest * kLeastSteps);
  const double widest = std::max(across.half_width(narrowest), along.half_width(narrowest));
  const double least = std::max(narrowest, kThinnest * widest);
  const double width = across.half_width(least), height = along.half_width(least);
  return make_frame(light, (right - across.middle() * axis) * (scale / width),
                    (up - along.middle() * axis) * (scale / height), axis * scale);
}

simd::ShadowFrame turned(const simd::ShadowFrame& frame) {
  simd::ShadowFrame result = frame;
  for (int k = 0; k < 3; ++k) {
    result.rows[0][k] = frame.rows[1][k];
    result.rows[1][k] = -frame.rows[0][k];  // keeps the determinant above 0
  }
  return result;
}

simd::ShadowFrame frame_of_side(const Vector& light, int side, double reach) {
  const int axis = side / 2;
  DVector rows[3] = {DVector(0), DVector(0), DVector(0)};
  const double sign = side % 2 == 0 ? 1 : -1, scale = 1 / reach;
  rows[0][(axis + 1) % 3] = scale / kRim;
  rows[1][(axis + 2) % 3] = sign * scale / kRim;  // keeps the determinant above 0
  rows[2][axis] = sign * scale;
  return make_frame(light, rows[0], rows[1], rows[2]);
}

}  // namespace facemap
