#include "simd/list_planes.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/list_planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/vectors-inl.h"

#ifndef FACEMAP_SIMD_LIST_PLANES_ONCE
#define FACEMAP_SIMD_LIST_PLANES_ONCE
namespace facemap::simd {

// Roundings between a true product m . d and the filter's, in units of 2^-24 |m| |d|: m to float32 (1), d to float32
// (1) and kDirectionError, three products and two sums (3). 6 leaves room for the rounding of the bound itself and for
// second-order terms.
inline constexpr double kDotRoundings = 6 * 0x1p-24;

// The offset rounded to float32 (1) and the last subtraction (1, of a result that is at most |n . D| + offset).
inline constexpr double kOffsetRoundings = 3 * 0x1p-24;

// Doubles, sizes |p| being sums of components. Differences of floats are off by a relative u = 2^-53; a component of a
// cross product a x b by 4 u (|ay bz| + |az by|), the three together by 4 u |a| |b|; a determinant n . a with
// n = b x c by 8 u |a| |b| |c|. Twice that for the roundings of these bounds.
inline constexpr double kCrossError = 8 * 0x1p-53;
inline constexpr double kDeterminantError = 16 * 0x1p-53;

// A bound that no product of a plane and a direction exceeds: of lengths 2 and kLargestLength.
inline constexpr double kUseless = 0x1p70;

}  // namespace facemap::simd
#endif

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
// Of this file alone: the same names stand for other lanes elsewhere.
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using FloatTag = hn::Rebind<float, Tag>;
using BitsTag = hn::Rebind<std::uint64_t, Tag>;
using V = hn::Vec<Tag>;
using Vector = Vector3<V>;

HWY_INLINE V times(V v, double factor) { return hn::Mul(v, hn::Set(Tag(), factor)); }

HWY_INLINE Vector corner(const SetupCorners& corners, int k, std::size_t i) {
  const Tag tag;
  const FloatTag half;
  return {hn::PromoteTo(tag, hn::Load(half, corners.of[k][0] + i)),
          hn::PromoteTo(tag, hn::Load(half, corners.of[k][1] + i)),
          hn::PromoteTo(tag, hn::Load(half, corners.of[k][2] + i))};
}

// 2^-k for the k with 2^k <= x < 2^(k+1). Products of two lengths are 0 or above 2^-300.
HWY_INLINE V inverse_power_of_two(V x) {
  const BitsTag bits;
  const auto exponent = hn::ShiftRight<52>(hn::BitCast(bits, hn::Max(x, hn::Set(Tag(), 0x1p-400))));
  return hn::BitCast(Tag(), hn::ShiftLeft<52>(hn::Sub(hn::Set(bits, 2046), exponent)));
}

HWY_INLINE void store(V value, float* to) { hn::Store(hn::DemoteTo(FloatTag(), value), FloatTag(), to); }

// Rounded up: rounding to float32 takes away 2^-24 at most. Beyond kUseless nothing is decided anyway.
HWY_INLINE void store_above(V value, float* to) {
  const V above = hn::Add(times(value, 1 + 0x1p-23), hn::Set(Tag(), 0x1p-140));
  store(hn::Min(above, hn::Set(Tag(), kUseless)), to);
}

// Stores a plane scaled to a length in [1, 2) and returns the bound of its error, relative to the direction's length.
// `error`: of the doubles.
HWY_INLINE V store_plane(const Vector& m, V length, V error, int plane, std::size_t i, SetupPlanes& planes) {
  const V factor = inverse_power_of_two(length);
  store(hn::Mul(m.x, factor), planes.x[plane] + i);
  store(hn::Mul(m.y, factor), planes.y[plane] + i);
  store(hn::Mul(m.z, factor), planes.z[plane] + i);
  return hn::Mul(hn::Add(times(length, kDotRoundings), times(error, 2)), factor);
}

HWY_INLINE V length_of(const Vector& a) { return hn::Sqrt(dot(a, a)); }

HWY_INLINE void set_up_some(const SetupCorners& corners, const float origin[3], double scale, std::size_t i,
                            SetupPlanes& planes) {
  const Tag tag;
  const Vector O{hn::Set(tag, origin[0]), hn::Set(tag, origin[1]), hn::Set(tag, origin[2])};
  const Vector a = corner(corners, 0, i), b = corner(corners, 1, i), c = corner(corners, 2, i);
  const Vector from_O[3] = {a - O, b - O, c - O}, along[3] = {b - a, c - b, a - c};

  // Of a face's edges each is taken from its own two corners, so that what is near one of them stays sharp.
  V error = hn::Zero(tag), nearest = hn::Set(tag, 0x1p600), longest = hn::Zero(tag);
  for (int k = 0; k < 3; ++k) {
    const Vector m = cross(from_O[k], along[k]);
    const V m_error = times(hn::Mul(sum_of_sizes(from_O[k]), sum_of_sizes(along[k])), kCrossError);
    error = hn::Max(error, store_plane(m, length_of(m), m_error, k, i, planes));
    nearest = hn::Min(nearest, dot(from_O[k], from_O[k]));
    longest = hn::Max(longest, dot(along[k], along[k]));
  }

  const Vector ac = c - a, n = cross(along[0], ac);
  const V sizes = hn::Mul(sum_of_sizes(along[0]), sum_of_sizes(ac)), n_length = length_of(n);
  const V n_error = times(sizes, kCrossError);
  error = hn::Max(error, store_plane(n, n_length, n_error, 3, i, planes));
  store_above(error, planes.error + i);

  const V determinant = dot(n, from_O[0]);
  const V determinant_error = times(hn::Mul(sizes, sum_of_sizes(from_O[0])), kDeterminantError);
  const V distance = hn::Abs(determinant);
  const V map_units = times(inverse_power_of_two(n_length), scale);
  const V offset = hn::Mul(determinant, map_units), most = hn::Set(tag, kUseless);
  store(hn::Min(hn::Max(offset, hn::Neg(most)), most), planes.offset + i);
  store_above(hn::Mul(hn::Add(times(distance, kOffsetRoundings), times(determinant_error, 2)), map_units),
              planes.offset_error + i);

  hn::Store(hn::Sqrt(nearest), tag, planes.nearest_corner + i);
  hn::Store(hn::Sqrt(longest), tag, planes.longest_edge + i);
  const V numerator = hn::Sub(distance, times(determinant_error, 2));
  hn::Store(hn::Div(numerator, hn::Add(n_length, times(n_error, 2))), tag, planes.plane_distance + i);

  alignas(64) double sides[kSetupFaces];
  const V one = hn::Set(tag, 1.0);
  const V sign = hn::IfThenElse(hn::Lt(determinant, hn::Zero(tag)), hn::Neg(one), one);
  hn::Store(hn::IfThenElseZero(hn::Gt(distance, determinant_error), sign), tag, sides);
  for (std::size_t k = 0; k < hn::Lanes(tag); ++k) planes.side[i + k] = static_cast<std::int8_t>(sides[k]);
}

}  // namespace

void set_up_list_planes(const SetupCorners& corners, const float origin[3], double scale, SetupPlanes& planes) {
  for (std::size_t i = 0; i < kSetupFaces; i += hn::Lanes(Tag())) set_up_some(corners, origin, scale, i, planes);
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void set_up_list_planes(const SetupCorners& corners, const float origin[3], double scale, SetupPlanes& planes) {
  FACEMAP_DISPATCH(set_up_list_planes)(corners, origin, scale, planes);
}

}  // namespace facemap::simd
#endif
