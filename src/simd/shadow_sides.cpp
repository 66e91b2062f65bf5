#include "simd/shadow_sides.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shadow_sides.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/shadow_project-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {

// The bit of the side along an axis or against it.
HWY_INLINE hn::Vec<DU> bit_of(hn::Vec<DF> component, int axis) {
  const DF d;
  const DU du;
  const auto is_against = hn::RebindMask(du, hn::Lt(component, hn::Zero(d)));
  return hn::IfThenElse(is_against, hn::Set(du, 2u << (2 * axis)), hn::Set(du, 1u << (2 * axis)));
}

// Bits of lanes from `count` on are not set.
HWY_INLINE void split_lanes(const Run& run, std::size_t i, std::size_t count, std::uint8_t* out, SideCounts& counts) {
  const DF d;
  const DU du;
  const hn::Rebind<std::uint8_t, DU> db;
  const auto X = hn::Load(d, run.X + i), Y = hn::Load(d, run.Y + i), Z = hn::Load(d, run.Z + i);
  const auto x = hn::Abs(X), y = hn::Abs(Y), z = hn::Abs(Z);
  const auto xy = hn::IfThenElse(hn::RebindMask(du, hn::Gt(y, x)), bit_of(Y, 1), bit_of(X, 0));
  const auto all = hn::IfThenElse(hn::RebindMask(du, hn::Gt(z, hn::Max(x, y))), bit_of(Z, 2), xy);
  const auto is_listed = hn::Lt(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(count)));
  const auto bits = hn::IfThenElseZero(is_listed, all);
  hn::StoreU(hn::DemoteTo(db, hn::BitCast(DI(), bits)), db, out);
  for (unsigned side = 0; side < kSides; ++side) {
    counts.of[side] += hn::CountTrue(du, hn::Eq(bits, hn::Set(du, 1u << side)));
  }
}

SideCounts split_by_side(const ListedPoints& list, const PointTransform& by, std::uint8_t* bits) {
  SideCounts counts;
  Run run;
  for (std::size_t first = 0; first < list.count; first += kRun) {
    transform(by, list.x + first, list.y + first, list.z + first, run);
    for (std::size_t i = 0; i < kRun && first + i < list.count; i += hn::Lanes(DF())) {
      split_lanes(run, i, list.count - (first + i), bits + first + i, counts);
    }
  }
  return counts;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

SideCounts split_by_side(const ListedPoints& list, const PointTransform& transform, std::uint8_t* bits) {
  return FACEMAP_DISPATCH(split_by_side)(list, transform, bits);
}

}  // namespace facemap::simd
#endif
