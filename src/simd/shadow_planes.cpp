#include "simd/shadow_planes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shadow_planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/vectors-inl.h"

#ifndef FACEMAP_SIMD_SHADOW_PLANES_ONCE
#define FACEMAP_SIMD_SHADOW_PLANES_ONCE
namespace facemap::simd {

// Units of 2^-24 |coefficient|, for every point of the raster (|u|, |v| <= 1). An edge: the coefficient rounded (1),
// the point (2), the product (1), two sums (2). 1/4 for what is of second order, the bound's own roundings included.
inline constexpr double kEdgeRoundings = 6.25;

// The plane: one subtraction more, of the sum and of the product with w, which carries three roundings. Where w is at
// most 1.1 (|A| + |B| + |C|), A, B, C being the plane's coefficients for a w of 1, that makes 7 + 3.3. Where w is
// greater the point is in front of the plane, and no rounding brings the computed difference above 0.
inline constexpr double kPlaneRoundings = 10.6;

// Doubles, in units of 2^-53 of products of lengths. N_i bounds each of X, Y, Z of a vector i: N = largest |p|_1. A
// vector is off by 4 N (difference, product, two sums); a component of a cross product by 20.1 N_i N_j, the three
// together by 61; of edge 1-2, which is made of three of them, by 73; the determinant by 102 N_0 N_1 N_2.
inline constexpr double kDoubleRoundings = 0x1p7 * 0x1p-53;

// A determinant that is known to 1 in 2^16 adds nothing to speak of to the plane's bound.
inline constexpr double kSharpDeterminant = 0x1p16;

// Bounds outside these are not for float32.
inline constexpr double kLeastBound = 0x1p-90;
inline constexpr double kGreatestBound = 0x1p90;

}  // namespace facemap::simd
#endif

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
// Of this file alone: the same names stand for other lanes elsewhere.
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using DD = hn::CappedTag<double, 8>;
using DHalf = hn::Rebind<float, DD>;
using VD = hn::Vec<DD>;
using Vector = Vector3<VD>;

HWY_INLINE Vector transformed(const ShadowFrame& frame, const Vector& p) {
  const DD d;
  const auto row = [&](int i) HWY_ATTR {
    return dot({hn::Set(d, frame.rows[i][0]), hn::Set(d, frame.rows[i][1]), hn::Set(d, frame.rows[i][2])}, p);
  };
  return {row(0), row(1), row(2)};
}

HWY_INLINE Vector corner(const ShadowCorners& corners, int k, std::size_t i) {
  const DD d;
  const DHalf half;
  return {hn::PromoteTo(d, hn::Load(half, corners.of[k][0] + i)),
          hn::PromoteTo(d, hn::Load(half, corners.of[k][1] + i)),
          hn::PromoteTo(d, hn::Load(half, corners.of[k][2] + i))};
}

// 1 / bound, made in float32 since it need not be exact; 0 where the bound is not for float32 (or NaN).
HWY_INLINE VD inverse_of(VD bound) {
  const DD d;
  const DHalf half;
  const auto is_usable = hn::And(hn::Ge(bound, hn::Set(d, kLeastBound)), hn::Le(bound, hn::Set(d, kGreatestBound)));
  const auto usable = hn::IfThenElse(is_usable, bound, hn::Set(d, 1.0));
  const auto inverse = hn::Div(hn::Set(half, 1.0f), hn::DemoteTo(half, usable));
  return hn::IfThenElseZero(is_usable, hn::PromoteTo(d, inverse));
}

HWY_INLINE void store(VD value, float* out) {
  const DHalf half;
  hn::Store(hn::DemoteTo(half, value), half, out);
}

// The edge's plane times `sign`, over its bound; `error`: of the doubles.
HWY_INLINE void store_edge(const Vector& m, VD sign, VD error, double roundings, std::size_t i,
                           float (*edge)[ShadowPlanes::kFaces]) {
  const DD d;
  const auto bound = hn::Add(hn::Mul(sum_of_sizes(m), hn::Set(d, roundings * kShadowHalfUlp)), error);
  const auto factor = hn::Mul(inverse_of(bound), sign);
  store(hn::Mul(m.x, factor), edge[0] + i);
  store(hn::Mul(m.y, factor), edge[1] + i);
  store(hn::Mul(m.z, factor), edge[2] + i);
}

HWY_INLINE void set_up_some(const ShadowFrame& frame, const ShadowCorners& corners, std::size_t i, double slack,
                            ShadowPlanes& planes, std::int8_t* sides) {
  const DD d;
  const Vector a = corner(corners, 0, i);
  const Vector to_a = a - Vector{hn::Set(d, frame.light[0]), hn::Set(d, frame.light[1]), hn::Set(d, frame.light[2])};
  const Vector ab = corner(corners, 1, i) - a, ac = corner(corners, 2, i) - a;
  const Vector A = transformed(frame, to_a), B = transformed(frame, ab), C = transformed(frame, ac);

  // Edge a-b: A x B; edge c-a: (A + C) x -C = C x A; edge b-c: (A + B) x (C - B), which is the rest of the normal.
  const Vector normal = cross(B, C), edge_ab = cross(A, B), edge_ca = cross(C, A);
  const Vector edge_bc = (normal - edge_ab) - edge_ca;
  const auto determinant = dot(A, normal);

  const auto largest = hn::Set(d, frame.largest);
  const auto size_a = hn::Mul(sum_of_sizes(to_a), largest);
  const auto size_b = hn::Mul(sum_of_sizes(ab), largest), size_c = hn::Mul(sum_of_sizes(ac), largest);
  const auto rounding = hn::Set(d, kDoubleRoundings);
  const auto normal_error = hn::Mul(hn::Mul(size_b, size_c), rounding);
  const auto edge_error = hn::Add(hn::Mul(hn::Mul(size_a, hn::Add(size_b, size_c)), rounding), normal_error);
  const auto determinant_error = hn::Mul(size_a, normal_error);

  const auto size = hn::Abs(determinant), one = hn::Set(d, 1.0);
  const auto is_sure = hn::Gt(size, determinant_error);
  const auto is_entry = hn::And(is_sure, hn::Lt(determinant, hn::Zero(d)));
  const auto sign = hn::IfThenElse(is_entry, hn::Neg(one), one);
  const double edge_roundings = kEdgeRoundings + slack, plane_roundings = kPlaneRoundings + slack;
  store_edge(edge_ab, sign, edge_error, edge_roundings, i, planes.edges[0]);
  store_edge(edge_bc, sign, edge_error, edge_roundings, i, planes.edges[1]);
  store_edge(edge_ca, sign, edge_error, edge_roundings, i, planes.edges[2]);

  // Over |determinant| this would be a plane for w itself; over its bound it needs no division.
  const auto is_sharp = hn::Gt(size, hn::Mul(determinant_error, hn::Set(d, kSharpDeterminant)));
  const auto bound = hn::Add(hn::Mul(sum_of_sizes(normal), hn::Set(d, plane_roundings * kShadowHalfUlp)), normal_error);
  const auto inverse = hn::IfThenElseZero(is_sharp, inverse_of(bound));
  const auto factor = hn::Mul(inverse, sign);
  store(hn::Mul(normal.x, factor), planes.plane[0] + i);
  store(hn::Mul(normal.y, factor), planes.plane[1] + i);
  store(hn::Mul(normal.z, factor), planes.plane[2] + i);
  store(hn::Mul(size, inverse), planes.plane[3] + i);

  alignas(64) double signs[8];
  hn::Store(hn::IfThenElseZero(is_sure, sign), d, signs);
  for (std::size_t k = 0; k < hn::Lanes(d); ++k) sides[i + k] = static_cast<std::int8_t>(signs[k]);
}

}  // namespace

void set_up_planes(const ShadowFrame& frame, const ShadowCorners* corners, std::size_t groups, double slack,
                   ShadowPlanes* planes, std::int8_t* sides) {
  for (std::size_t g = 0; g < groups; ++g) {
    for (std::size_t i = 0; i < ShadowPlanes::kFaces; i += hn::Lanes(DD())) {
      set_up_some(frame, corners[g], i, slack, planes[g], sides + g * ShadowPlanes::kFaces);
    }
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void set_up_planes(const ShadowFrame& frame, const ShadowCorners* corners, std::size_t groups, double slack,
                   ShadowPlanes* planes, std::int8_t* sides) {
  FACEMAP_DISPATCH(set_up_planes)(frame, corners, groups, slack, planes, sides);
}

}  // namespace facemap::simd
#endif
