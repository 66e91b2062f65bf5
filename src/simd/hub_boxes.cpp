#include "simd/hub_boxes.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/hub_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"

#ifndef FACEMAP_SIMD_HUB_BOXES_ONCE
#define FACEMAP_SIMD_HUB_BOXES_ONCE
namespace facemap::simd {

// How far (u and v alike) a direction may be outside the box of the face that it meets: a box's side and its depth are
// off by 2^-24 each, their quotient by one rounding more, D w by 2^-23 and its greatest component by as much. Less than
// 2^-20 where it matters, as |u| <= 1 there; the way to a texel's number is off by 2^-23.
inline constexpr float kHubMargin = 0x1p-18f;

// What may hide between a computed w and a true one, relative.
inline constexpr float kHubDepthFactor = 1 + 0x1p-18f;

// Boxes nearer than this, along their side's axis, are as if the hub were in them.
inline constexpr float kLeastBoxDistance = 0x1p-40f;

// Less than kNoHubTarget, and above each segment's own w.
inline constexpr float kAnyHubTarget = 0x1p100f;

}  // namespace facemap::simd
#endif

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
// Of this file alone: the same names stand for other lanes elsewhere.
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;

constexpr std::size_t kLanes = hn::MaxLanes(DF());

// Column or row of a coordinate: monotone in it, whatever the rounding. Boxes use the same steps.
HWY_INLINE VI texel_of(VF coordinate, int count) {
  const DF d;
  const auto half = hn::Set(d, 0.5f * static_cast<float>(count));
  const auto place = hn::Add(hn::Mul(coordinate, half), half);
  const auto last = hn::Set(d, static_cast<float>(count - 1));
  return hn::ConvertTo(DI(), hn::Min(hn::Max(place, hn::Zero(d)), last));
}

struct Range {
  VF lower, upper;
};

// Of x / z over a box with z from z0 to z1, z1 > 0; of its part in front of the hub where z0 is not.
HWY_INLINE Range quotients(const Range& x, VF nearest, VF farthest) {
  const DF d;
  const auto zero = hn::Zero(d), margin = hn::Set(d, kHubMargin);
  const auto lower = hn::Mul(x.lower, hn::IfThenElse(hn::Lt(x.lower, zero), nearest, farthest));
  const auto upper = hn::Mul(x.upper, hn::IfThenElse(hn::Gt(x.upper, zero), nearest, farthest));
  return {hn::Sub(lower, margin), hn::Add(upper, margin)};
}

struct Lanes {
  alignas(64) std::int32_t columns[2][16], rows[2][16];
  alignas(64) float u[2][16], v[2][16], w[16];
};

HWY_INLINE std::uint32_t bits_of(hn::Mask<DI> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(DI(), mask, bytes);
  return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
}

// One bit a box that some segment of the side may be behind.
HWY_INLINE std::uint32_t sift_side(const Range* box, int axis, bool is_against, const HubRaster& raster, Lanes& to) {
  const DF d;
  const DI di;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const Range& along = box[axis];
  const auto z0 = is_against ? hn::Neg(along.upper) : along.lower;
  const auto z1 = is_against ? hn::Neg(along.lower) : along.upper;
  // What is on the side has |x| <= z somewhere, for each of the other axes.
  const Range &across = box[(axis + 1) % 3], &down = box[(axis + 2) % 3];
  const auto reach = hn::Mul(z1, hn::Set(d, kHubDepthFactor));
  const auto is_in_front =
      hn::And(hn::Gt(z1, zero), hn::And(hn::Le(hn::Max(across.lower, down.lower), reach),
                                        hn::Ge(hn::Min(across.upper, down.upper), hn::Neg(reach))));
  if (hn::AllFalse(d, is_in_front)) return 0;
  const auto least = hn::Set(d, kLeastBoxDistance);
  const auto is_apart = hn::Gt(z0, least);
  const auto nearest = hn::IfThenElse(is_apart, hn::Div(one, hn::Max(z0, least)), hn::Inf(d));
  const auto farthest = hn::Div(one, hn::Max(z1, least));
  const Range u = quotients(across, nearest, farthest);
  const Range v = quotients(down, nearest, farthest);
  const auto is_on_side =
      hn::And(is_in_front, hn::And(hn::Le(hn::Max(u.lower, v.lower), hn::Add(one, hn::Set(d, kHubMargin))),
                                   hn::Ge(hn::Min(u.upper, v.upper), hn::Sub(hn::Neg(one), hn::Set(d, kHubMargin)))));
  if (hn::AllFalse(d, is_on_side)) return 0;

  const int n = raster.texels;
  const auto x0 = texel_of(u.lower, n), x1 = texel_of(u.upper, n);
  const auto y0 = texel_of(v.lower, n), y1 = texel_of(v.upper, n);
  const auto* counts =
      reinterpret_cast<const std::int32_t*>(raster.counts) + (2 * axis + is_against) * (n + 1) * (n + 1);
  const auto stride = hn::Set(di, n + 1), next = hn::Set(di, 1);
  const auto above = hn::Mul(y0, stride), below = hn::Mul(hn::Add(y1, next), stride);
  const auto right = hn::Add(x1, next);
  const auto inside = hn::Sub(
      hn::Sub(hn::GatherIndex(di, counts, hn::Add(below, right)), hn::GatherIndex(di, counts, hn::Add(below, x0))),
      hn::Sub(hn::GatherIndex(di, counts, hn::Add(above, right)), hn::GatherIndex(di, counts, hn::Add(above, x0))));
  const auto is_left = hn::And(hn::RebindMask(di, is_on_side), hn::Gt(inside, hn::Zero(di)));
  const std::uint32_t bits = bits_of(is_left) & ((1u << kLanes) - 1);
  if (bits == 0) return 0;
  hn::Store(x0, di, to.columns[0]);
  hn::Store(x1, di, to.columns[1]);
  hn::Store(y0, di, to.rows[0]);
  hn::Store(y1, di, to.rows[1]);
  hn::Store(u.lower, d, to.u[0]);
  hn::Store(u.upper, d, to.u[1]);
  hn::Store(v.lower, d, to.v[0]);
  hn::Store(v.upper, d, to.v[1]);
  hn::Store(hn::IfThenElse(is_apart, hn::Mul(nearest, hn::Set(d, kHubDepthFactor)), hn::Set(d, kAnyHubTarget)), d,
            to.w);
  return bits;
}

}  // namespace

void find_hub_texels(const HubTargets& targets, std::size_t count, int texels, std::uint32_t* to) {
  const DF d;
  const DI di;
  const auto zero = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const auto x = hn::LoadU(d, targets.x + i), y = hn::LoadU(d, targets.y + i), z = hn::LoadU(d, targets.z + i);
    const auto ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
    const auto is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az)), is_y = hn::And(hn::Not(is_x), hn::Ge(ay, az));
    const auto along = hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z));
    const auto u = hn::IfThenElse(is_x, y, hn::IfThenElse(is_y, z, x));
    const auto v = hn::IfThenElse(is_x, z, hn::IfThenElse(is_y, x, y));
    const auto axis = hn::IfThenElseZero(hn::Not(hn::RebindMask(di, is_x)),
                                         hn::IfThenElse(hn::RebindMask(di, is_y), hn::Set(di, 2), hn::Set(di, 4)));
    const auto side = hn::Add(axis, hn::IfThenElseZero(hn::RebindMask(di, hn::Lt(along, zero)), hn::Set(di, 1)));
    const auto n = hn::Set(di, texels);
    const auto texel = hn::Add(hn::Mul(hn::Add(hn::Mul(side, n), texel_of(v, texels)), n), texel_of(u, texels));
    hn::StoreU(hn::BitCast(DU(), texel), DU(), to + i);
  }
}

std::size_t sift_boxes(const PackBoxes& boxes, const float* hub, const HubRaster& raster, HubBox* to) {
  const DF d;
  std::size_t count = 0;
  for (std::size_t i = 0; i < PackBoxes::kPacks; i += kLanes) {
    Range box[3];
    for (int k = 0; k < 3; ++k) {
      const auto from = hn::Set(d, hub[k]);
      box[k] = {hn::Sub(hn::Load(d, boxes.lower[k] + i), from), hn::Sub(hn::Load(d, boxes.upper[k] + i), from)};
    }
    for (int side = 0; side < kHubSides; ++side) {
      Lanes lanes;
      std::uint32_t bits = sift_side(box, side / 2, side % 2 != 0, raster, lanes);
      for (; bits != 0; bits &= bits - 1) {
        const auto k = static_cast<std::size_t>(__builtin_ctz(bits));
        to[count++] = {static_cast<std::uint32_t>(i + k),
                       static_cast<std::uint32_t>(side),
                       lanes.columns[0][k],
                       lanes.columns[1][k],
                       lanes.rows[0][k],
                       lanes.rows[1][k],
                       lanes.u[0][k],
                       lanes.u[1][k],
                       lanes.v[0][k],
                       lanes.v[1][k],
                       lanes.w[k]};
      }
    }
  }
  return count;
}

std::size_t find_behind(const HubBox& box, const HubRaster& raster, const HubTargets& targets, std::uint32_t* places) {
  const DF d;
  const DU du;
  const float* const coordinates[3] = {targets.x, targets.y, targets.z};
  const float* const us = coordinates[(box.side / 2 + 1) % 3];
  const float* const vs = coordinates[(box.side / 2 + 2) % 3];
  const auto u0 = hn::Set(d, box.u0), u1 = hn::Set(d, box.u1), v0 = hn::Set(d, box.v0), v1 = hn::Set(d, box.v1);
  const auto greatest = hn::Set(d, box.w);
  std::size_t count = 0;
  for (std::int32_t row = box.row; row <= box.last_row; ++row) {
    const std::uint32_t* begins =
        raster.begins + (static_cast<std::int32_t>(box.side) * raster.texels + row) * raster.texels;
    const std::uint32_t end = begins[box.last_column + 1];
    for (std::uint32_t i = begins[box.column]; i < end; i += kLanes) {
      const auto u = hn::LoadU(d, us + i), v = hn::LoadU(d, vs + i), w = hn::LoadU(d, targets.w + i);
      const auto place = hn::Add(hn::Iota(du, 0), hn::Set(du, i));
      const auto is_on = hn::And(hn::And(hn::Ge(u, u0), hn::Le(u, u1)), hn::And(hn::Ge(v, v0), hn::Le(v, v1)));
      const auto is_there =
          hn::And(hn::RebindMask(du, hn::And(is_on, hn::Le(w, greatest))), hn::Lt(place, hn::Set(du, end)));
      count += hn::CompressStore(place, is_there, du, places + count);
    }
  }
  return count;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void find_hub_texels(const HubTargets& targets, std::size_t count, int texels, std::uint32_t* to) {
  FACEMAP_DISPATCH(find_hub_texels)(targets, count, texels, to);
}

std::size_t sift_boxes(const PackBoxes& boxes, const float* hub, const HubRaster& raster, HubBox* to) {
  return FACEMAP_DISPATCH(sift_boxes)(boxes, hub, raster, to);
}

std::size_t find_behind(const HubBox& box, const HubRaster& raster, const HubTargets& targets, std::uint32_t* places) {
  return FACEMAP_DISPATCH(find_behind)(box, raster, targets, places);
}

}  // namespace facemap::simd
#endif
