#include "simd/shadow_points.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shadow_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/shadow_project-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
constexpr std::size_t kLanes = hn::MaxLanes(DF());

HWY_INLINE void mark_spots(hn::Vec<DF> u, hn::Vec<DF> v, const ShadowRaster& raster, std::size_t count,
                           std::uint8_t* occupied) {
  const auto column = texel_of(u, raster.columns * kSpotColumns), row = texel_of(v, raster.rows * kSpotRows);
  alignas(64) std::int32_t spots[kLanes] = {};
  hn::Store(hn::Add(hn::Mul(row, hn::Set(DI(), raster.columns * kSpotColumns)), column), DI(), spots);
  for (std::size_t k = 0; k < count; ++k) {
    const auto spot = static_cast<std::uint32_t>(spots[k]);
    occupied[spot / 8] = static_cast<std::uint8_t>(occupied[spot / 8] | 1u << (spot % 8));
  }
}

HWY_INLINE void append_rest(hn::Vec<DU> number, hn::Mask<DU> is_rest, std::vector<std::uint32_t>& rest) {
  const std::size_t before = rest.size();
  rest.resize(before + kMostLanes);  // room for what is stored, the same on every target
  rest.resize(before + hn::CompressStore(number, is_rest, DU(), rest.data() + before));
}

// A vector of points, those on the raster first.
struct Placed {
  hn::Vec<DF> u, v, w;
  hn::Vec<DU> number;
  std::size_t count;
};

// `left`: how many of the lanes are points.
HWY_INLINE Placed place_lanes(const Run& run, std::size_t i, std::size_t left, const std::uint32_t* numbers,
                              float nearest, std::vector<std::uint32_t>& rest) {
  const DF d;
  const DU du;
  const auto one = hn::Set(d, 1.0f), Z = hn::Load(d, run.Z + i);
  Placed p;
  p.w = hn::Div(one, Z);
  p.u = hn::Mul(hn::Load(d, run.X + i), p.w);
  p.v = hn::Mul(hn::Load(d, run.Y + i), p.w);
  p.number = hn::LoadU(du, numbers);
  p.count = kLanes;
  const auto is_inside = hn::And(hn::Le(hn::Max(hn::Abs(p.u), hn::Abs(p.v)), one), hn::Ge(Z, hn::Set(d, nearest)));
  const auto is_listed = hn::Lt(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(left)));
  const auto is_on = hn::And(is_listed, hn::RebindMask(du, is_inside));
  if (hn::AllTrue(du, is_on)) return p;
  const auto is_rest = hn::AndNot(hn::RebindMask(du, is_inside), is_listed);
  if (!hn::AllFalse(du, is_rest)) append_rest(p.number, is_rest, rest);
  p.u = hn::Compress(p.u, hn::RebindMask(d, is_on));
  p.v = hn::Compress(p.v, hn::RebindMask(d, is_on));
  p.w = hn::Compress(p.w, hn::RebindMask(d, is_on));
  p.number = hn::Compress(p.number, is_on);
  p.count = hn::CountTrue(du, is_on);
  return p;
}

// Works in place. No more points are stored than were read, and what is stored never overtakes what is read: the
// coordinates of a whole run are read before any of its points is stored, the numbers of a vector before it is.
static_assert(kRun % kLanes == 0 && kListPadding >= kRun);  // the last run is read past the end

ProjectedPoints project_points(const ListedPoints& from, const PointTransform& by, const ShadowRaster& on_raster,
                               std::uint32_t* texels, std::uint32_t* ranks, const TexelCounts& to_count,
                               std::vector<std::uint32_t>& rest) {
  const DU du;
  const DI di;
  const ListedPoints list = from;  // nothing that is stored changes the copies
  const ShadowRaster raster = on_raster;
  const TexelCounts counts = to_count;
  const float nearest = by.nearest;
  ProjectedPoints to{list.x, list.y, list.z, list.numbers, texels, ranks, 0};
  Run run;
  for (std::size_t first = 0; first < list.count; first += kRun) {
    transform(by, list.x + first, list.y + first, list.z + first, run);
    const std::size_t left = std::min(kRun, list.count - first);
    for (std::size_t i = 0; i < left; i += kLanes) {
      const Placed p = place_lanes(run, i, left - i, list.numbers + first + i, nearest, rest);
      const auto column = texel_of(p.u, raster.columns), row = texel_of(p.v, raster.rows);
      const auto texel = hn::BitCast(du, hn::Add(hn::Mul(row, hn::Set(DI(), raster.columns)), column));
      hn::StoreU(hn::BitCast(di, p.u), di, to.u + to.count);
      hn::StoreU(hn::BitCast(di, p.v), di, to.v + to.count);
      hn::StoreU(hn::BitCast(di, p.w), di, to.w + to.count);
      hn::StoreU(p.number, du, to.numbers + to.count);
      hn::StoreU(texel, du, texels + to.count);
      if (counts.occupied != nullptr) mark_spots(p.u, p.v, raster, p.count, counts.occupied);
      alignas(64) std::uint32_t at[kLanes];
      hn::Store(texel, du, at);
      std::uint32_t* const rank = ranks + to.count;
      if (p.count == kLanes) {
        for (std::size_t k = 0; k < kLanes; ++k) rank[k] = counts.of[at[k]]++;
      } else {
        for (std::size_t k = 0; k < p.count; ++k) rank[k] = counts.of[at[k]]++;
      }
      to.count += p.count;
    }
  }
  // Vectors past the end read points that exist.
  std::fill_n(to.numbers + to.count, kLanes, 0);
  std::fill_n(to.texels + to.count, kLanes, 0);
  return to;
}

HWY_INLINE hn::Vec<DF> float_at(const std::int32_t* bits) { return hn::BitCast(DF(), hn::LoadU(DI(), bits)); }

// Places of kRun points from number `first` on, which are fetched: they are all over more memory than is near.
HWY_INLINE void find_places(const ProjectedPoints& points, std::size_t first, const std::uint32_t* begins,
                            const PlacedPoints& to, std::uint32_t* places) {
  const DU du;
  const DI di;
  for (std::size_t i = 0; i < kRun && first + i < points.count; i += kLanes) {
    const auto texel = hn::BitCast(di, hn::LoadU(du, points.texels + first + i));
    const auto rank = hn::LoadU(du, points.ranks + first + i);
    hn::Store(hn::Add(hn::GatherIndex(du, begins, texel), rank), du, places + i);
  }
  for (std::size_t i = 0; i < kRun && first + i < points.count; ++i) {
    __builtin_prefetch(to.records + std::size_t{places[i]} * sizeof(ShadowRecord), 1);
    __builtin_prefetch(to.point_of_place + places[i], 1);
  }
}

void place_points(const ProjectedPoints& from, const std::uint32_t* own_faces, const std::uint32_t* begins,
                  const PlacedPoints& placed) {
  const DF d;
  const DU du;
  const DI di;
  const ProjectedPoints points = from;  // nothing that is stored changes the copies
  const PlacedPoints to = placed;
  alignas(64) ShadowRecord records[kLanes];
  alignas(64) std::uint32_t places[2][kRun];
  find_places(points, 0, begins, to, places[0]);
  for (std::size_t first = 0; first < points.count; first += kRun) {
    const std::uint32_t* const now = places[first / kRun % 2];
    find_places(points, first + kRun, begins, to, places[(first / kRun + 1) % 2]);
    for (std::size_t i = 0; i < kRun && first + i < points.count; i += kLanes) {
      const std::size_t at = first + i, lanes = std::min(kLanes, points.count - at);
      const auto number = hn::BitCast(di, hn::LoadU(du, points.numbers + at));
      const auto own_face = hn::BitCast(d, hn::GatherIndex(du, own_faces, number));
      hn::StoreInterleaved4(float_at(points.u + at), float_at(points.v + at), float_at(points.w + at), own_face, d,
                            &records[0].u);
      for (std::size_t k = 0; k < lanes; ++k) {
        std::memcpy(to.records + std::size_t{now[i + k]} * sizeof(ShadowRecord), &records[k], sizeof(ShadowRecord));
        to.point_of_place[now[i + k]] = points.numbers[at + k];
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

ProjectedPoints project_points(const ListedPoints& list, const PointTransform& transform, const ShadowRaster& raster,
                               std::uint32_t* texels, std::uint32_t* ranks, const TexelCounts& counts,
                               std::vector<std::uint32_t>& rest) {
  return FACEMAP_DISPATCH(project_points)(list, transform, raster, texels, ranks, counts, rest);
}

void place_points(const ProjectedPoints& points, const std::uint32_t* own_faces, const std::uint32_t* begins,
                  const PlacedPoints& to) {
  FACEMAP_DISPATCH(place_points)(points, own_faces, begins, to);
}

void finish_blocks(ShadowBlock* blocks, std::size_t count, float* farthest) {
  FACEMAP_DISPATCH(finish_blocks)(blocks, count, farthest);
}

}  // namespace facemap::simd
#endif
