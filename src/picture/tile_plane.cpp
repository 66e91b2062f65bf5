#include "picture/tile_plane.h"

#include <algorithm>
#include <cmath>

#include "math/dvector.h"
#include "simd/nearest_tile.h"

namespace facemap {
namespace {

constexpr double kFloatHalfUlp = 0x1p-24;
constexpr double kDoubleHalfUlp = 0x1p-53;

void store(const DVector& axis, double length, double row[3]) {
  row[0] = axis.x * length;
  row[1] = axis.y * length;
  row[2] = axis.z * length;
}

}  // namespace

void set_axes(const DVector& x, const DVector& y, const DVector& z, double f, double unit, simd::PlaneFrame& frame) {
  store(x, f * unit, frame.rows[0]);
  store(y, f * unit, frame.rows[1]);
  store(z, unit, frame.rows[2]);
  frame.unit = unit;
}

void set_errors(double f, double reach, double shift, simd::PlaneFrame& frame) {
  frame.shift = shift;
  frame.value_error = 64 * kDoubleHalfUlp * f * (2 * reach + f);
  frame.determinant_error = 128 * kDoubleHalfUlp * f * f;
}

// Any orthonormal axes about z will do, of determinant 1.
void TilePlane::look_along(const DVector& z, double f, double unit, const Vector& position) {
  const DVector other = std::fabs(z.x) < 0.6 ? DVector(1, 0, 0) : DVector(0, 1, 0);
  const DVector x = normalized(cross(other, z)), y = cross(z, x);
  set_axes(x, y, z, f, unit, frame);
  for (int i = 0; i < 3; ++i) frame.origin[i] = position[i];
  store(x, 1, axes_[0]);
  store(y, 1, axes_[1]);
  store(z, 1, axes_[2]);
  per_radian_ = f;
  reach = 0;
}

void TilePlane::set_points(const float* x, const float* y, const float* z, std::size_t first, std::size_t count) {
  reach = std::max(reach, simd::find_tile_points(axes_, per_radian_, x, y, z, count, u + first, v + first));
}

// Points are rounded to float32; in double, sums and the division lose less than 2^-48 of f.
void TilePlane::set_errors() {
  facemap::set_errors(per_radian_, reach, 2 * kFloatHalfUlp * reach + 0x1p-44 * per_radian_, frame);
}

}  // namespace facemap
