#include "simd/given_pairs.h"

#include <algorithm>

#include "math/plain_bounds.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/given_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/vectors-inl.h"

#ifndef FACEMAP_SIMD_GIVEN_PAIRS_ONCE
#define FACEMAP_SIMD_GIVEN_PAIRS_ONCE
namespace facemap::simd {

// As math/plain_signs.cpp has them, operation by operation. The side: 6 monomials, 8 roundings. A product of an offset,
// itself a rounded difference, with what has 2 monomials a component after 4 roundings: see error_of_product.
inline constexpr double kSideBound = plain::bound(8, 6);
inline constexpr double kProductBound = 6 * plain::kMargin * (plain::bound(1, 1) + plain::bound(7, 1));

}  // namespace facemap::simd
#endif

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
// Of this file alone: the same names stand for other lanes elsewhere.
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using DD = hn::CappedTag<double, 8>;
using DF = hn::Rebind<float, DD>;
using VD = hn::Vec<DD>;
using Vector = Vector3<VD>;

constexpr std::size_t kLanes = hn::MaxLanes(DD());

// Pairs that are fetched from memory together.
constexpr std::size_t kRun = 64;
static_assert(kRun % kLanes == 0);

struct Run {
  alignas(64) float points[3][kRun];
  alignas(64) float corners[3][3][kRun];
};

HWY_INLINE Vector load(const float (*from)[kRun], std::size_t i) {
  const DD d;
  const DF df;
  const auto lanes = [&](int k) HWY_ATTR { return hn::PromoteTo(d, hn::Load(df, from[k] + i)); };
  return {lanes(0), lanes(1), lanes(2)};
}

HWY_INLINE VD largest(const Vector& a) { return hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); }
HWY_INLINE VD largest(const Vector& a, const Vector& b, const Vector& c) {
  return hn::Max(hn::Max(largest(a), largest(b)), largest(c));
}

HWY_INLINE void fetch_faces(const GivenPoints& given, const GivenPair* pairs, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    __builtin_prefetch(given.corners + 3 * std::size_t{pairs[i].face});
    __builtin_prefetch(given.points + 3 * std::size_t{pairs[i].point});
  }
}

HWY_INLINE void fetch_vertices(const GivenPoints& given, const GivenPair* pairs, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t* corners = given.corners + 3 * std::size_t{pairs[i].face};
    for (int k = 0; k < 3; ++k) __builtin_prefetch(given.positions + 3 * std::size_t{corners[k]});
  }
}

HWY_INLINE void fill(const GivenPoints& given, const GivenPair* pairs, std::size_t count, Run& run) {
  for (std::size_t i = 0; i < kRun; ++i) {
    const GivenPair& pair = pairs[std::min(i, count - 1)];
    const float* point = given.points + 3 * std::size_t{pair.point};
    const std::uint32_t* corners = given.corners + 3 * std::size_t{pair.face};
    for (int axis = 0; axis < 3; ++axis) run.points[axis][i] = point[axis];
    for (int k = 0; k < 3; ++k) {
      const float* corner = given.positions + 3 * std::size_t{corners[k]};
      for (int axis = 0; axis < 3; ++axis) run.corners[k][axis][i] = corner[axis];
    }
  }
}

// Whether a component of the cross product of two edges is 0 for having a factor 0 in both terms; edges are 0 exactly
// where coordinates are equal.
HWY_INLINE hn::Mask<DD> is_nothing(VD a1, VD b2, VD a2, VD b1) {
  const VD zero = hn::Zero(DD());
  return hn::And(hn::Or(hn::Eq(a1, zero), hn::Eq(b2, zero)), hn::Or(hn::Eq(a2, zero), hn::Eq(b1, zero)));
}

// Whether n . (P - a) is 0 for having a factor 0 in each term: so it is for points in planes along the axes.
HWY_INLINE hn::Mask<DD> is_in_plane(const Vector& a, const Vector& b, const Vector& from_plane) {
  const VD zero = hn::Zero(DD());
  const auto x = hn::Or(is_nothing(a.y, b.z, a.z, b.y), hn::Eq(from_plane.x, zero));
  const auto y = hn::Or(is_nothing(a.z, b.x, a.x, b.z), hn::Eq(from_plane.y, zero));
  const auto z = hn::Or(is_nothing(a.x, b.y, a.y, b.x), hn::Eq(from_plane.z, zero));
  return hn::And(hn::And(x, y), z);
}

// 0, 1 or 2 a lane.
HWY_INLINE VD verdicts_of(const Run& run, std::size_t i, const Vector& light) {
  const DD d;
  const Vector P = load(run.points, i), a = load(run.corners[0], i), b = load(run.corners[1], i),
               c = load(run.corners[2], i);
  const Vector edges[3] = {b - a, c - b, a - c};
  const Vector corners[3] = {a - light, b - light, c - light};
  const VD edge_size = largest(edges[0], edges[1], edges[2]), squared = hn::Mul(edge_size, edge_size);
  const Vector normal = cross(edges[2], edges[0]);

  const VD det = dot(normal, corners[0]);
  const VD det_error = hn::Mul(hn::Mul(hn::Set(d, kSideBound), squared), largest(corners[0]));
  const auto is_sided = hn::Gt(hn::Abs(det), det_error);
  const VD side = hn::CopySign(hn::Set(d, 1.0), det);

  const Vector from_plane = P - a, offset = P - light;
  const VD height = hn::Mul(side, dot(normal, from_plane)), product = hn::Set(d, kProductBound);
  const VD underflow = hn::Set(d, plain::kUnderflow);
  const VD height_error = hn::Add(hn::Mul(hn::Mul(product, squared), largest(from_plane)), underflow);
  const VD size = hn::Mul(largest(corners[0], corners[1], corners[2]), edge_size);
  const VD error = hn::Add(hn::Mul(hn::Mul(product, size), largest(offset)), underflow);
  const auto edge_value = [&](int k) HWY_ATTR { return hn::Mul(side, dot(cross(corners[k], edges[k]), offset)); };
  const VD least = hn::Min(hn::Min(edge_value(0), edge_value(1)), edge_value(2));

  const auto is_yes = hn::And(hn::Gt(height, height_error), hn::Gt(least, error));
  const auto is_no = hn::Or(hn::Lt(height, hn::Neg(height_error)), hn::Lt(least, hn::Neg(error)));
  const VD verdict = hn::IfThenElse(is_yes, hn::Set(d, 1.0), hn::IfThenElse(is_no, hn::Zero(d), hn::Set(d, 2.0)));
  return hn::IfThenZeroElse(is_in_plane(edges[2], edges[0], from_plane),
                            hn::IfThenElse(is_sided, verdict, hn::Set(d, 2.0)));
}

}  // namespace

void decide_pairs(const GivenPoints& given, const GivenPair* pairs, std::size_t count, std::uint8_t* verdicts) {
  const DD d;
  const Vector light{hn::Set(d, double{given.light[0]}), hn::Set(d, double{given.light[1]}),
                     hn::Set(d, double{given.light[2]})};
  const auto left = [&](std::size_t first) { return first < count ? std::min(kRun, count - first) : 0; };
  fetch_faces(given, pairs, left(0));
  fetch_faces(given, pairs + std::min(kRun, count), left(kRun));
  fetch_vertices(given, pairs, left(0));
  Run run;
  alignas(64) double results[kLanes];
  for (std::size_t first = 0; first < count; first += kRun) {
    if (first + 2 * kRun < count) fetch_faces(given, pairs + first + 2 * kRun, left(first + 2 * kRun));
    if (first + kRun < count) fetch_vertices(given, pairs + first + kRun, left(first + kRun));
    fill(given, pairs + first, left(first), run);
    for (std::size_t i = 0; i < left(first); i += kLanes) {
      hn::Store(verdicts_of(run, i, light), d, results);
      for (std::size_t k = 0; k < kLanes && first + i + k < count; ++k) {
        verdicts[first + i + k] = static_cast<std::uint8_t>(results[k]);
      }
    }
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void decide_pairs(const GivenPoints& given, const GivenPair* pairs, std::size_t count, std::uint8_t* verdicts) {
  FACEMAP_DISPATCH(decide_pairs)(given, pairs, count, verdicts);
}

}  // namespace facemap::simd
#endif
