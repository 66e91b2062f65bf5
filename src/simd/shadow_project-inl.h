// How kernels put points on a light's raster. Included once a target, as foreach_target.h has it.
#include <algorithm>
#include <cstring>

#include "simd/shadow_points.h"

#if defined(FACEMAP_SHADOW_PROJECT) == defined(HWY_TARGET_TOGGLE)
#ifdef FACEMAP_SHADOW_PROJECT
#undef FACEMAP_SHADOW_PROJECT
#else
#define FACEMAP_SHADOW_PROJECT
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Of a vector of any target.
constexpr std::size_t kMostLanes = 16;

using DF = hn::CappedTag<float, kMostLanes>;
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using DD = hn::CappedTag<double, 8>;
using DHalfF = hn::Rebind<float, DD>;
using DHalfI = hn::Rebind<std::int32_t, DD>;

// Points are transformed this many at a time, in doubles, before they are divided.
constexpr std::size_t kRun = 64;

struct Run {
  alignas(64) float X[kRun], Y[kRun], Z[kRun];
};

// One coordinate of a row: ((m0 x + m1 y) + m2 z) + offset.
HWY_INLINE hn::Vec<DD> row_of(const double* row, double offset, hn::Vec<DD> x, hn::Vec<DD> y, hn::Vec<DD> z) {
  const DD d;
  const auto xy = hn::Add(hn::Mul(hn::Set(d, row[0]), x), hn::Mul(hn::Set(d, row[1]), y));
  return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, row[2]), z)), hn::Set(d, offset));
}

// Of kRun points.
struct RunPoints {
  const std::int32_t *x, *y, *z;
  alignas(64) std::int32_t copy[3][kRun];  // where fewer are left
};

// Points first.. of `count`; zeros after the last.
HWY_INLINE void set_run(const std::int32_t* x, const std::int32_t* y, const std::int32_t* z, std::size_t first,
                        std::size_t count, RunPoints& run) {
  run.x = x + first;
  run.y = y + first;
  run.z = z + first;
  const std::size_t left = count - first;
  if (left >= kRun) return;
  std::memset(run.copy, 0, sizeof(run.copy));
  std::copy_n(run.x, left, run.copy[0]);
  std::copy_n(run.y, left, run.copy[1]);
  std::copy_n(run.z, left, run.copy[2]);
  run.x = run.copy[0];
  run.y = run.copy[1];
  run.z = run.copy[2];
}

// kRun points that stand side by side.
HWY_INLINE void transform(const PointTransform& by, const std::int32_t* px, const std::int32_t* py,
                          const std::int32_t* pz, Run& run) {
  const DD d;
  const DHalfF half;
  const DHalfI half_int;
  for (std::size_t i = 0; i < kRun; i += hn::Lanes(d)) {
    const auto x = hn::PromoteTo(d, hn::LoadU(half_int, px + i));
    const auto y = hn::PromoteTo(d, hn::LoadU(half_int, py + i));
    const auto z = hn::PromoteTo(d, hn::LoadU(half_int, pz + i));
    hn::Store(hn::DemoteTo(half, row_of(by.matrix[0], by.offset[0], x, y, z)), half, run.X + i);
    hn::Store(hn::DemoteTo(half, row_of(by.matrix[1], by.offset[1], x, y, z)), half, run.Y + i);
    hn::Store(hn::DemoteTo(half, row_of(by.matrix[2], by.offset[2], x, y, z)), half, run.Z + i);
  }
}

HWY_INLINE void transform(const PointsToProject& from, std::size_t first, Run& run) {
  RunPoints points;
  set_run(from.x, from.y, from.z, first, from.count, points);
  transform(from, points.x, points.y, points.z, run);
}

// Column or row of a coordinate: monotone in it, whatever the rounding. The spans of faces use the same steps.
HWY_INLINE hn::Vec<DI> texel_of(hn::Vec<DF> coordinate, int count) {
  const DF d;
  const auto half = hn::Set(d, 0.5f * static_cast<float>(count));
  const auto place = hn::Add(hn::Mul(coordinate, half), half);
  const auto last = hn::Set(d, static_cast<float>(count - 1));
  return hn::ConvertTo(DI(), hn::Min(hn::Max(place, hn::Zero(d)), last));
}

// Of kRun points.
HWY_INLINE bool is_any_wanted(const std::uint8_t* wanted, std::uint8_t bit) {
  std::uint64_t words[kRun / 8], all = 0;
  std::memcpy(words, wanted, sizeof(words));
  for (const std::uint64_t word : words) all |= word;
  return (all & bit * 0x0101010101010101u) != 0;
}

}  // namespace
}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
