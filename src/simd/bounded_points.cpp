#include "simd/bounded_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/bounded_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/shadow_project-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {

using DBytes = hn::Rebind<std::uint8_t, DU>;

// Puts where the open lanes lie at the `at`th place.
HWY_INLINE void store_places(const OpenPlaces& places, std::size_t at, hn::Vec<DF> u, hn::Vec<DF> v, hn::Vec<DF> number,
                             hn::Mask<DU> is_on, hn::Mask<DU> is_open) {
  const DU du;
  const DI di;
  const auto last = hn::Set(di, kTexelSpots - 1), size = hn::Set(di, places.size);
  const auto column = texel_of(u, kTexelSpots * places.size), row = texel_of(v, kTexelSpots * places.size);
  const auto texel =
      hn::Add(hn::Mul(hn::ShiftRight<kTexelSpotsLog2>(row), size), hn::ShiftRight<kTexelSpotsLog2>(column));
  const auto spot = hn::Add(hn::ShiftLeft<kTexelSpotsLog2>(hn::And(row, last)), hn::And(column, last));
  const auto depth = hn::Or(hn::ShiftLeft<16>(spot), hn::ConvertTo(di, number));
  hn::CompressStore(hn::IfThenElse(is_on, hn::BitCast(du, texel), hn::Set(du, OpenPlaces::kNone)), is_open, du,
                    places.texels + at);
  hn::CompressStore(hn::BitCast(du, depth), is_open, du, places.depths + at);
}

// Decides points i.. of a run that begins at `first`; `wanted` are those of the run.
HWY_INLINE void decide_lanes(const PointsToProject& from, const TexelBounds& bounds, const Run& run,
                             const std::uint8_t* wanted, std::size_t first, std::size_t i, std::uint8_t* dark,
                             std::uint32_t* open, const OpenPlaces& places, PointCounts& counts) {
  const DF d;
  const DU du;
  const DI di;
  const DBytes db;
  const auto is_wanted = hn::TestBit(hn::PromoteTo(du, hn::LoadU(db, wanted + i)), hn::Set(du, from.bit));
  if (hn::AllFalse(du, is_wanted)) return;
  counts.asked += hn::CountTrue(du, is_wanted);

  const auto one = hn::Set(d, 1.0f), Z = hn::Load(d, run.Z + i);
  const auto w = hn::Div(one, Z);
  const auto u = hn::Mul(hn::Load(d, run.X + i), w), v = hn::Mul(hn::Load(d, run.Y + i), w);
  const auto is_inside = hn::And(hn::Le(hn::Max(hn::Abs(u), hn::Abs(v)), one), hn::Ge(Z, hn::Set(d, from.nearest)));
  const auto is_on = hn::And(is_wanted, hn::RebindMask(du, is_inside));
  const auto place = hn::Add(hn::Mul(texel_of(v, bounds.size), hn::Set(di, bounds.size)), texel_of(u, bounds.size));
  const auto texel = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(bounds.texels),
                                     hn::IfThenElseZero(hn::RebindMask(di, is_on), place));
  const auto upper = hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, texel))));
  const auto lower = hn::ConvertTo(d, hn::And(texel, hn::Set(di, 0xffff)));
  const auto steps = hn::Mul(hn::Sub(w, hn::Set(d, bounds.w_least)), hn::Set(d, bounds.w_scale));
  const auto number = hn::Max(hn::Min(steps, hn::Set(d, TexelBounds::kSteps)), hn::Zero(d));
  const auto is_dark = hn::And(is_on, hn::RebindMask(du, hn::Lt(number, lower)));
  const auto is_lit = hn::And(is_on, hn::RebindMask(du, hn::Or(hn::Gt(number, upper), hn::Eq(upper, hn::Zero(d)))));
  const auto bytes = hn::IfThenElseZero(is_dark, hn::Set(du, 1));
  hn::StoreU(hn::DemoteTo(db, hn::BitCast(di, bytes)), db, dark + first + i);
  const auto is_open = hn::AndNot(hn::Or(is_dark, is_lit), is_wanted);
  if (hn::AllFalse(du, is_open)) return;
  const auto numbers = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(first + i)));
  if (places.texels != nullptr) store_places(places, counts.open, u, v, number, is_on, is_open);
  counts.open += hn::CompressStore(numbers, is_open, du, open + counts.open);
}

PointCounts decide_points(const PointsToProject& from, const TexelBounds& bounds, std::size_t first, std::size_t last,
                          std::uint8_t* dark, std::uint32_t* open, const OpenPlaces& places) {
  PointCounts counts;
  Run run;
  for (; first < last; first += kRun) {
    std::memset(dark + first, 0, kRun);
    std::uint8_t end[kRun] = {};
    const std::uint8_t* wanted = from.wanted + first;
    if (from.count - first < kRun) {
      std::copy_n(wanted, from.count - first, end);
      wanted = end;
    }
    if (!is_any_wanted(wanted, from.bit)) continue;
    transform(from, first, run);
    for (std::size_t i = 0; i < kRun; i += hn::Lanes(DF())) {
      decide_lanes(from, bounds, run, wanted, first, i, dark, open, places, counts);
    }
  }
  return counts;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

PointCounts decide_points(const PointsToProject& from, const TexelBounds& bounds, std::size_t first, std::size_t last,
                          std::uint8_t* dark, std::uint32_t* open, const OpenPlaces& places) {
  return FACEMAP_DISPATCH(decide_points)(from, bounds, first, last, dark, open, places);
}

}  // namespace facemap::simd
#endif
