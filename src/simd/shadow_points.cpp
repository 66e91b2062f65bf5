#include "simd/shadow_points.h"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shadow_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/shadow_project-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
using DBytes = hn::Rebind<std::uint8_t, DU>;

// ---- which, and where

struct Bounds {
  hn::Vec<DI> lower[3], upper[3];
};

HWY_INLINE std::size_t widen(Bounds& bounds, const std::int32_t* const* coordinates, const std::uint8_t* wanted,
                             std::size_t first) {
  const DI di;
  const DU du;
  const auto bytes = hn::PromoteTo(du, hn::LoadU(DBytes(), wanted + first));
  const auto is_wanted = hn::RebindMask(di, hn::Ne(bytes, hn::Zero(du)));
  if (hn::AllFalse(di, is_wanted)) return 0;
  for (int k = 0; k < 3; ++k) {
    const auto x = hn::LoadU(di, coordinates[k] + first);
    bounds.lower[k] = hn::IfThenElse(is_wanted, hn::Min(bounds.lower[k], x), bounds.lower[k]);
    bounds.upper[k] = hn::IfThenElse(is_wanted, hn::Max(bounds.upper[k], x), bounds.upper[k]);
  }
  return hn::CountTrue(di, is_wanted);
}

WantedPoints measure_wanted(const std::int32_t* x, const std::int32_t* y, const std::int32_t* z,
                            const std::uint8_t* wanted, std::size_t count) {
  const DI di;
  const std::size_t lanes = hn::Lanes(di), whole = count / lanes * lanes;
  Bounds bounds;
  for (int k = 0; k < 3; ++k) {
    bounds.lower[k] = hn::Set(di, std::numeric_limits<std::int32_t>::max());
    bounds.upper[k] = hn::Set(di, std::numeric_limits<std::int32_t>::min());
  }
  WantedPoints measured{};
  const std::int32_t* const coordinates[3] = {x, y, z};
  for (std::size_t i = 0; i < whole; i += lanes) measured.count += widen(bounds, coordinates, wanted, i);
  std::int32_t last[3][16] = {};
  std::uint8_t last_wanted[64] = {};
  const std::int32_t* const last_coordinates[3] = {last[0], last[1], last[2]};
  for (int k = 0; k < 3; ++k) std::copy(coordinates[k] + whole, coordinates[k] + count, last[k]);
  std::copy(wanted + whole, wanted + count, last_wanted);
  measured.count += widen(bounds, last_coordinates, last_wanted, 0);
  for (int k = 0; k < 3; ++k) {
    measured.lower[k] = hn::GetLane(hn::MinOfLanes(di, bounds.lower[k]));
    measured.upper[k] = hn::GetLane(hn::MaxOfLanes(di, bounds.upper[k]));
  }
  return measured;
}

// ---- onto the raster

// A vector of points on the raster.
struct Placed {
  hn::Vec<DF> u, v, w;
  hn::Vec<DU> texel;
  hn::Mask<DU> is_on, is_rest;
  unsigned on;  // one bit a lane
};

// False if none of them is asked about.
HWY_INLINE bool place_lanes(const PointsToProject& from, const ShadowRaster& raster, const Run& run, std::size_t first,
                            std::size_t i, Placed& p) {
  const DF d;
  const DU du;
  const auto bytes = hn::PromoteTo(du, hn::LoadU(DBytes(), from.wanted + first + i));
  const auto number = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(first + i)));
  const auto is_within = hn::Lt(number, hn::Set(du, static_cast<std::uint32_t>(from.count)));
  const auto is_wanted = hn::And(hn::TestBit(bytes, hn::Set(du, from.bit)), is_within);
  if (hn::AllFalse(du, is_wanted)) return false;

  const auto one = hn::Set(d, 1.0f), Z = hn::Load(d, run.Z + i);
  p.w = hn::Div(one, Z);
  p.u = hn::Mul(hn::Load(d, run.X + i), p.w);
  p.v = hn::Mul(hn::Load(d, run.Y + i), p.w);
  const auto is_inside = hn::And(hn::Le(hn::Max(hn::Abs(p.u), hn::Abs(p.v)), one), hn::Ge(Z, hn::Set(d, from.nearest)));
  p.is_on = hn::And(is_wanted, hn::RebindMask(du, is_inside));
  p.is_rest = hn::AndNot(hn::RebindMask(du, is_inside), is_wanted);
  const auto column = texel_of(p.u, raster.columns), row = texel_of(p.v, raster.rows);
  p.texel = hn::BitCast(du, hn::Add(hn::Mul(row, hn::Set(DI(), raster.columns)), column));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(du, p.is_on, bits);
  p.on = bits[0] | static_cast<unsigned>(bits[1]) << 8;
  return true;
}

HWY_INLINE void mark_spots(const Placed& p, const ShadowRaster& raster, std::uint8_t* occupied) {
  const auto column = texel_of(p.u, raster.columns * kSpotColumns), row = texel_of(p.v, raster.rows * kSpotRows);
  alignas(64) std::int32_t spots[16];
  hn::Store(hn::Add(hn::Mul(row, hn::Set(DI(), raster.columns * kSpotColumns)), column), DI(), spots);
  for (unsigned on = p.on; on != 0; on &= on - 1) {
    const auto spot = static_cast<std::uint32_t>(spots[__builtin_ctz(on)]);
    occupied[spot / 8] = static_cast<std::uint8_t>(occupied[spot / 8] | 1u << (spot % 8));
  }
}

std::size_t count_points(const PointsToProject& from, const ShadowRaster& raster, std::uint32_t* counts,
                         std::uint8_t* occupied, std::vector<std::uint32_t>& rest) {
  const DU du;
  const std::size_t lanes = hn::Lanes(du);
  std::size_t count = 0;
  Run run;
  Placed p;
  for (std::size_t first = 0; first < from.count; first += kRun) {
    if (!is_any_wanted(from.wanted + first, from.bit)) continue;
    transform(from, first, run);
    for (std::size_t i = 0; i < kRun && first + i < from.count; i += lanes) {
      if (!place_lanes(from, raster, run, first, i, p)) continue;
      if (!hn::AllFalse(du, p.is_rest)) {
        const auto number = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(first + i)));
        const std::size_t before = rest.size();
        rest.resize(before + 16);
        rest.resize(before + hn::CompressStore(number, p.is_rest, du, rest.data() + before));
      }
      if (occupied != nullptr) mark_spots(p, raster, occupied);
      alignas(64) std::uint32_t texels[16];
      hn::Store(p.texel, du, texels);
      count += static_cast<unsigned>(__builtin_popcount(p.on));
      if (hn::AllTrue(du, p.is_on)) {
        for (std::size_t k = 0; k < lanes; ++k) ++counts[texels[k]];
      } else {
        for (unsigned on = p.on; on != 0; on &= on - 1) ++counts[texels[__builtin_ctz(on)]];
      }
    }
  }
  return count;
}

void place_points(const PointsToProject& from, const ShadowRaster& raster, std::uint32_t* next, std::byte* records,
                  std::uint32_t* point_of_place) {
  const DF d;
  const DU du;
  const std::size_t lanes = hn::Lanes(d);
  Run run;
  Placed p;
  for (std::size_t first = 0; first < from.count; first += kRun) {
    if (!is_any_wanted(from.wanted + first, from.bit)) continue;
    transform(from, first, run);
    for (std::size_t i = 0; i < kRun && first + i < from.count; i += lanes) {
      if (!place_lanes(from, raster, run, first, i, p)) continue;
      alignas(64) ShadowRecord lane_records[16];
      alignas(64) std::uint32_t texels[16];
      hn::StoreInterleaved4(p.u, p.v, p.w, hn::BitCast(d, hn::Load(du, run.own_face + i)), d, &lane_records[0].u);
      hn::Store(p.texel, du, texels);
      const auto number = static_cast<std::uint32_t>(first + i);
      if (hn::AllTrue(du, p.is_on)) {
        for (std::uint32_t k = 0; k < lanes; ++k) {
          const std::uint32_t place = next[texels[k]]++;
          std::memcpy(records + std::size_t{place} * sizeof(ShadowRecord), &lane_records[k], sizeof(ShadowRecord));
          point_of_place[place] = number + k;
        }
        continue;
      }
      for (unsigned on = p.on; on != 0; on &= on - 1) {
        const auto k = static_cast<std::uint32_t>(__builtin_ctz(on));
        const std::uint32_t place = next[texels[k]]++;
        std::memcpy(records + std::size_t{place} * sizeof(ShadowRecord), &lane_records[k], sizeof(ShadowRecord));
        point_of_place[place] = number + k;
      }
    }
  }
}

void finish_blocks(ShadowBlock* blocks, std::size_t count, float* farthest) {
  const DF d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t b = 0; b < count; ++b) {
    ShadowBlock& block = blocks[b];
    alignas(64) float records[4 * ShadowBlock::kPoints];
    std::memcpy(records, &block, sizeof(records));
    auto least = hn::Set(d, 0x1p127f);
    for (std::size_t i = 0; i < ShadowBlock::kPoints; i += lanes) {
      hn::Vec<DF> u, v, w, own_face;
      hn::LoadInterleaved4(d, records + 4 * i, u, v, w, own_face);
      hn::Store(u, d, block.u + i);
      hn::Store(v, d, block.v + i);
      hn::Store(w, d, block.w + i);
      hn::Store(hn::BitCast(DU(), own_face), DU(), block.own_face + i);
      least = hn::Min(least, w);
    }
    farthest[b] = hn::GetLane(hn::MinOfLanes(d, least));
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

std::size_t count_points(const PointsToProject& from, const ShadowRaster& raster, std::uint32_t* counts,
                         std::uint8_t* occupied, std::vector<std::uint32_t>& rest) {
  return FACEMAP_DISPATCH(count_points)(from, raster, counts, occupied, rest);
}

void place_points(const PointsToProject& from, const ShadowRaster& raster, std::uint32_t* next, std::byte* records,
                  std::uint32_t* point_of_place) {
  FACEMAP_DISPATCH(place_points)(from, raster, next, records, point_of_place);
}

WantedPoints measure_wanted(const std::int32_t* x, const std::int32_t* y, const std::int32_t* z,
                            const std::uint8_t* wanted, std::size_t count) {
  return FACEMAP_DISPATCH(measure_wanted)(x, y, z, wanted, count);
}

void finish_blocks(ShadowBlock* blocks, std::size_t count, float* farthest) {
  FACEMAP_DISPATCH(finish_blocks)(blocks, count, farthest);
}

}  // namespace facemap::simd
#endif
