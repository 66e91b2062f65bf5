#include "picture/face_texels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simd/shadow_frame.h"

namespace facemap {
namespace {

using simd::kShadowMargin;

// A vertex's computed place is off by less than this, u and v alike, and so is a point's; w is off by less than this,
// relative.
constexpr double kOff = kShadowMargin;

// Faces whose box has more texels are held against each of them.
constexpr int kSmallBox = 6;

// Slopes of w are made from a determinant that is known to 1 in so many.
constexpr double kSharp = 16;

double size_of(double u, double v) { return std::fabs(u) + std::fabs(v); }

}  // namespace

int texel_of(float coordinate, int size) {
  const float half = 0.5f * static_cast<float>(size), last = static_cast<float>(size - 1);
  return static_cast<int>(std::min(std::max(coordinate * half + half, 0.0f), last));
}

FaceTexels::FaceTexels(const float* a, const float* b, const float* c, int size) : size_(size), half_(1.0 / size) {
  least_ = std::min({a[2], b[2], c[2]}) / simd::kShadowDepthFactor;
  greatest_ = std::max({a[2], b[2], c[2]}) * simd::kShadowDepthFactor;
  const float reach = 2 * kShadowMargin;
  const float u0 = std::min({a[0], b[0], c[0]}) - reach, u1 = std::max({a[0], b[0], c[0]}) + reach;
  const float v0 = std::min({a[1], b[1], c[1]}) - reach, v1 = std::max({a[1], b[1], c[1]}) + reach;
  column0_ = row0_ = 0;
  column1_ = row1_ = -1;
  if (!(u0 <= 1 && u1 >= -1 && v0 <= 1 && v1 >= -1)) return;
  column0_ = texel_of(u0, size);
  column1_ = texel_of(u1, size);
  row0_ = texel_of(v0, size);
  row1_ = texel_of(v1, size);

  const double bu = double{b[0]} - a[0], bv = double{b[1]} - a[1], cu = double{c[0]} - a[0], cv = double{c[1]} - a[1];
  const double area = bu * cv - cu * bv;
  // A difference of two corners is off by 2 kOff in each coordinate; the area by that times their sizes, and a square.
  const double sizes = size_of(bu, bv) + size_of(cu, cv);
  const double area_error = 2 * kOff * sizes + 8 * kOff * kOff;
  if (std::fabs(area) > area_error) side_ = area > 0 ? 1 : -1;
  is_large_ = (column1_ - column0_ + 1) * (row1_ - row0_ + 1) > kSmallBox && side_ != 0;
  if (!is_large_) return;

  // Any place of a true point in one of the texels is so near to the texel's middle, and so near to the corners.
  const double near = half_ + 4 * kOff, far = double{u1} - u0 + v1 - v0 + 4 * near;
  const float* corners[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    const float *from = corners[k], *to = corners[(k + 1) % 3];
    const double du = side_ * (double{to[0]} - from[0]), dv = side_ * (double{to[1]} - from[1]);
    edges_[k] = {dv * from[0] - du * from[1], -dv, du, size_of(du, dv) * near + 4 * kOff * far};
  }
  has_plane_ = std::fabs(area) > kSharp * area_error;
  if (!has_plane_) return;
  const double bw = double{b[2]} - a[2], cw = double{c[2]} - a[2];
  plane_ = {a[0], a[1], a[2], (bw * cv - cw * bv) / area, (bu * cw - cu * bw) / area, 0};
  // Each slope: a product of a difference of w (off by 2 kOff w) and one of places (off by 2 kOff), over the area,
  // whose own error is at most 1 in kSharp.
  const double slope = size_of(plane_.by_u, plane_.by_v);
  const double slope_error = 2 * (4 * kOff * greatest_ * (1 + sizes) + area_error * slope) / std::fabs(area);
  plane_.range = slope * near + slope_error * far + 4 * kOff * greatest_;
}

// Columns of a row that the edges leave to the face, their range taken `sign` times.
FaceTexels::Span FaceTexels::span_in(int row, int sign) const {
  const double v = (2 * row + 1) * half_ - 1;
  double first = column0_, last = column1_;
  for (const Edge& e : edges_) {
    const double value = e.at + e.by_v * v + sign * e.range;  // + by_u u >= 0
    if (e.by_u == 0) {
      if (value < 0) return {0, -1};
      continue;
    }
    // The column of u = -value / by_u, rounded away from the face or into it by a hundredth of a texel.
    const double column = 0.5 * ((1 - value / e.by_u) * size_ - 1);
    if (e.by_u > 0) {
      first = std::max(first, std::ceil(column - 0.01 * sign));
    } else {
      last = std::min(last, std::floor(column + 0.01 * sign));
    }
  }
  return first <= last ? Span{static_cast<int>(first), static_cast<int>(last)} : Span{0, -1};
}

}  // namespace facemap
