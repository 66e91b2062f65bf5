#include "simd/listed_points.h"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/listed_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/pack-inl.h"
#include "simd/shadow_project-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {

using DBytes = hn::Rebind<std::uint8_t, DU>;
constexpr std::size_t kLanes = hn::MaxLanes(DF());

// Masks of kRun points from number `first` on, side by side; zeros after the last.
HWY_INLINE const std::uint8_t* masks_of_run(const std::uint8_t* masks, std::size_t stride, std::size_t first,
                                            std::size_t count, std::uint8_t* copy) {
  const std::size_t left = std::min(kRun, count - first);
  if (stride == 1 && left == kRun) return masks + first;
  std::memset(copy, 0, kRun);
  for (std::size_t i = 0; i < left; ++i) copy[i] = masks[(first + i) * stride];
  return copy;
}

void count_wanted(const std::uint8_t* masks, std::size_t stride, std::size_t count, std::size_t* counts) {
  const hn::CappedTag<std::uint8_t, kRun> d;
  std::uint8_t copy[kRun];
  for (std::size_t first = 0; first < count; first += kRun) {
    const std::uint8_t* run = masks_of_run(masks, stride, first, count, copy);
    for (std::size_t i = 0; i < kRun; i += hn::Lanes(d)) {
      const auto bytes = hn::LoadU(d, run + i);
      for (unsigned bit = 0; bit < 8; ++bit) {
        counts[bit] += hn::CountTrue(d, hn::TestBit(bytes, hn::Set(d, static_cast<std::uint8_t>(1u << bit))));
      }
    }
  }
}

struct Range {
  hn::Vec<DI> lower, upper;
};

HWY_INLINE Range empty_range() {
  const DI di;
  return {hn::Set(di, std::numeric_limits<std::int32_t>::max()), hn::Set(di, std::numeric_limits<std::int32_t>::min())};
}

// One coordinate of a vector of points, all of which are wanted.
HWY_INLINE void list_all_lanes(const std::int32_t* from, std::int32_t* to, Range& range) {
  const auto x = hn::LoadU(DI(), from);
  range.lower = hn::Min(range.lower, x);
  range.upper = hn::Max(range.upper, x);
  hn::StoreU(x, DI(), to);
}

// One coordinate of a vector of points, those of `wanted` side by side.
HWY_INLINE void list_lanes(const std::int32_t* from, hn::Mask<DI> wanted, const Packer<DI>& packer, std::int32_t* to,
                           Range& range) {
  const auto x = hn::LoadU(DI(), from);
  range.lower = hn::IfThenElse(wanted, hn::Min(range.lower, x), range.lower);
  range.upper = hn::IfThenElse(wanted, hn::Max(range.upper, x), range.upper);
  packer.store(x, to);
}

ListedBox list_wanted(const PointArrays& all, const WantedBits& asked, ListedPoints& to) {
  const PointArrays points = all;  // nothing that is stored changes the copies
  const WantedBits wanted = asked;
  const ListedPoints list = to;
  const DI di;
  const DU du;
  const auto bit = hn::Set(du, wanted.bit);
  std::size_t count = 0;
  Range x = empty_range(), y = empty_range(), z = empty_range();
  std::uint8_t copy[kRun];
  RunPoints run;
  for (std::size_t first = 0; first < points.count; first += kRun) {
    const std::uint8_t* masks = masks_of_run(wanted.masks, wanted.stride, first, points.count, copy);
    if (!is_any_wanted(masks, wanted.bit)) continue;
    set_run(points.x, points.y, points.z, first, points.count, run);
    for (std::size_t i = 0; i < kRun; i += kLanes) {
      const auto is_wanted = hn::TestBit(hn::PromoteTo(du, hn::LoadU(DBytes(), masks + i)), bit);
      if (hn::AllFalse(du, is_wanted)) continue;
      const auto number = hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(first + i)));
      std::int32_t* const numbers = reinterpret_cast<std::int32_t*>(list.numbers + count);
      if (hn::AllTrue(du, is_wanted)) {
        list_all_lanes(run.x + i, list.x + count, x);
        list_all_lanes(run.y + i, list.y + count, y);
        list_all_lanes(run.z + i, list.z + count, z);
        hn::StoreU(number, di, numbers);
        count += kLanes;
        continue;
      }
      const auto lanes = hn::RebindMask(di, is_wanted);
      const Packer<DI> packer(lanes);
      list_lanes(run.x + i, lanes, packer, list.x + count, x);
      list_lanes(run.y + i, lanes, packer, list.y + count, y);
      list_lanes(run.z + i, lanes, packer, list.z + count, z);
      packer.store(number, numbers);
      count += packer.count();
    }
  }
  to.count = count;
  ListedBox box;
  const Range* const ranges[3] = {&x, &y, &z};
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = hn::GetLane(hn::MinOfLanes(di, ranges[k]->lower));
    box.upper[k] = hn::GetLane(hn::MaxOfLanes(di, ranges[k]->upper));
  }
  return box;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void count_wanted(const std::uint8_t* masks, std::size_t stride, std::size_t count, std::size_t* counts) {
  FACEMAP_DISPATCH(count_wanted)(masks, stride, count, counts);
}

ListedBox list_wanted(const PointArrays& points, const WantedBits& wanted, ListedPoints& list) {
  return FACEMAP_DISPATCH(list_wanted)(points, wanted, list);
}

}  // namespace facemap::simd
#endif
