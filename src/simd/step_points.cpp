#include "simd/step_points.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/step_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
// Of this file alone: the same names stand for other lanes elsewhere.
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using DD = hn::CappedTag<double, 8>;
using DHalfF = hn::Rebind<float, DD>;
using DHalfI = hn::Rebind<std::int32_t, DD>;

constexpr std::size_t kLanes = hn::MaxLanes(DF()), kHalf = hn::MaxLanes(DD());

// A vector of points, the last of them repeated where there are fewer.
HWY_INLINE const float* whole(const float* points, std::size_t left, std::size_t lanes, float* copy) {
  if (left >= lanes) return points;
  for (std::size_t i = 0; i < lanes; ++i) std::copy_n(points + 3 * std::min(i, left - 1), 3, copy + 3 * i);
  return copy;
}

}  // namespace

PointBox box_of_points(const float* points, std::size_t count) {
  const DF d;
  hn::Vec<DF> lower[3], upper[3], sum = hn::Zero(d);  // of 0 times what is finite
  for (int k = 0; k < 3; ++k) lower[k] = upper[k] = hn::Set(d, points[k]);
  float copy[3 * kLanes];
  for (std::size_t i = 0; i < count; i += kLanes) {
    hn::Vec<DF> p[3];
    hn::LoadInterleaved3(d, whole(points + 3 * i, count - i, kLanes, copy), p[0], p[1], p[2]);
    for (int k = 0; k < 3; ++k) {
      lower[k] = hn::Min(lower[k], p[k]);
      upper[k] = hn::Max(upper[k], p[k]);
      sum = hn::Add(sum, hn::Mul(hn::Zero(d), p[k]));
    }
  }
  PointBox box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = hn::GetLane(hn::MinOfLanes(d, lower[k]));
    box.upper[k] = hn::GetLane(hn::MaxOfLanes(d, upper[k]));
  }
  box.is_finite = hn::AllTrue(d, hn::Eq(sum, hn::Zero(d)));
  return box;
}

void step_points(const float* points, std::size_t count, const PointSteps& by, std::int32_t* x, std::int32_t* y,
                 std::int32_t* z) {
  const DF df;
  const DD d;
  const DHalfF half;
  const DHalfI half_int;
  std::int32_t* const to[3] = {x, y, z};
  const auto per_step = hn::Set(d, by.per_step);
  float copy[3 * kLanes];
  for (std::size_t i = 0; i < count; i += kLanes) {
    hn::Vec<DF> p[3];
    hn::LoadInterleaved3(df, whole(points + 3 * i, count - i, kLanes, copy), p[0], p[1], p[2]);
    for (int k = 0; k < 3; ++k) {
      const auto origin = hn::Set(d, by.origin[k]);
      alignas(64) float coordinates[kLanes];
      alignas(64) std::int32_t steps[kLanes];
      hn::Store(p[k], df, coordinates);
      for (std::size_t j = 0; j < kLanes; j += kHalf) {
        const auto offset = hn::Sub(hn::PromoteTo(d, hn::Load(half, coordinates + j)), origin);
        hn::Store(hn::DemoteTo(half_int, hn::Round(hn::Mul(offset, per_step))), half_int, steps + j);
      }
      if (count - i >= kLanes) {
        hn::StoreU(hn::Load(DI(), steps), DI(), to[k] + i);
      } else {
        std::copy_n(steps, count - i, to[k] + i);
      }
    }
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

PointBox box_of_points(const float* points, std::size_t count) {
  return FACEMAP_DISPATCH(box_of_points)(points, count);
}

void step_points(const float* points, std::size_t count, const PointSteps& steps, std::int32_t* x, std::int32_t* y,
                 std::int32_t* z) {
  FACEMAP_DISPATCH(step_points)(points, count, steps, x, y, z);
}

}  // namespace facemap::simd
#endif
