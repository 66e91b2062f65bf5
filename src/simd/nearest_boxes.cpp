#include "simd/nearest_boxes.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using M = hn::Mask<D>;

constexpr float kLargestBulge = 0x1p20f;  // samples; keeps boxes that are not used within integers

struct Points {
  V u, v;
};

struct Boxes {
  VI x0, x1, y0, y1;
  M seen;
};

HWY_INLINE Points gather(const float* points, VU vertices) {
  const D d;
  const VI at = hn::BitCast(DI(), hn::ShiftLeft<1>(vertices));
  return {hn::GatherIndex(d, points, at), hn::GatherIndex(d, points + 1, at)};
}

HWY_INLINE V least(V a, V b, V c) { return hn::Min(hn::Min(a, b), c); }
HWY_INLINE V greatest(V a, V b, V c) { return hn::Max(hn::Max(a, b), c); }

HWY_INLINE VU bit_if(M holds, std::uint32_t bit) {
  const DU du;
  return hn::IfThenElseZero(hn::RebindMask(du, holds), hn::Set(du, bit));
}

// On which sides of the view a vertex surely lies, with a point or without.
HWY_INLINE VU outside(const BoxRules& r, const Points& p) {
  const D d;
  const DU du;
  const V edge_u = hn::Set(d, r.edge_u), edge_v = hn::Set(d, r.edge_v);
  const VU left_right = hn::Or(bit_if(hn::Lt(p.u, hn::Neg(edge_u)), kLeft), bit_if(hn::Gt(p.u, edge_u), kRight));
  const VU above_below = hn::Or(bit_if(hn::Lt(p.v, hn::Neg(edge_v)), kAbove), bit_if(hn::Gt(p.v, edge_v), kBelow));
  const VU named = hn::And(hn::BitCast(du, p.u), hn::Set(du, kOutsideBits));
  return hn::IfThenElse(hn::RebindMask(du, hn::IsNaN(p.u)), named, hn::Or(left_right, above_below));
}

// From the first sample at or after `low` to the last at or before `high`, within 0..count-1.
HWY_INLINE VI first_sample(V low, float origin) {
  const D d;
  return hn::Max(hn::ConvertTo(DI(), hn::Ceil(hn::Sub(low, hn::Set(d, origin)))), hn::Zero(DI()));
}
HWY_INLINE VI last_sample(V high, float origin, std::int32_t count) {
  const D d;
  return hn::Min(hn::ConvertTo(DI(), hn::Floor(hn::Sub(high, hn::Set(d, origin)))), hn::Set(DI(), count - 1));
}

HWY_INLINE Boxes boxes_of(const BoxRules& r, const Points& a, const Points& b, const Points& c) {
  const D d;
  const DI di;
  M pointless = hn::Or(hn::IsNaN(a.u), hn::Or(hn::IsNaN(b.u), hn::IsNaN(c.u)));
  Boxes box;
  const V zero = hn::Zero(d);  // a number where there is none, so that the conversion is defined
  const V u0 = hn::IfThenElse(pointless, zero, least(a.u, b.u, c.u));
  const V u1 = hn::IfThenElse(pointless, zero, greatest(a.u, b.u, c.u));
  const V v0 = hn::IfThenElse(pointless, zero, least(a.v, b.v, c.v));
  const V v1 = hn::IfThenElse(pointless, zero, greatest(a.v, b.v, c.v));
  V margin = hn::Set(d, r.margin);
  if (r.bulge > 0) {
    const V width = hn::Sub(u1, u0), height = hn::Sub(v1, v0);
    const V squared = hn::Add(hn::Mul(width, width), hn::Mul(height, height));
    pointless = hn::Or(pointless, hn::Gt(squared, hn::Set(d, r.longest_squared)));
    margin = hn::Add(margin, hn::Min(hn::Mul(hn::Set(d, r.bulge), squared), hn::Set(d, kLargestBulge)));
  }
  box.x0 = first_sample(hn::Sub(u0, margin), r.first_column);
  box.x1 = last_sample(hn::Add(u1, margin), r.first_column, r.columns);
  box.y0 = first_sample(hn::Sub(v0, margin), r.first_row);
  box.y1 = last_sample(hn::Add(v1, margin), r.first_row, r.rows);
  box.seen = hn::RebindMask(d, hn::Not(hn::Or(hn::Gt(box.x0, box.x1), hn::Gt(box.y0, box.y1))));
  if (hn::AllFalse(d, pointless)) return box;

  // Out of view if all three vertices are outside on one side; else the whole picture.
  const VU common = hn::And(outside(r, a), hn::And(outside(r, b), outside(r, c)));
  const M in_view = hn::RebindMask(d, hn::Eq(common, hn::Zero(DU())));
  const auto whole = hn::RebindMask(di, pointless);
  box.seen = hn::Or(hn::AndNot(pointless, box.seen), hn::And(pointless, in_view));
  box.x0 = hn::IfThenZeroElse(whole, box.x0);
  box.y0 = hn::IfThenZeroElse(whole, box.y0);
  box.x1 = hn::IfThenElse(whole, hn::Set(di, r.columns - 1), box.x1);
  box.y1 = hn::IfThenElse(whole, hn::Set(di, r.rows - 1), box.y1);
  return box;
}

HWY_INLINE void push(BoxQueue& queue, M which, VU faces, const Boxes& box) {
  const Packer<D> packer(which);
  const std::size_t n = queue.size;
  packer.store(box.x0, queue.x0 + n);
  packer.store(box.x1, queue.x1 + n);
  packer.store(box.y0, queue.y0 + n);
  packer.store(box.y1, queue.y1 + n);
  packer.store(faces, queue.faces + n);
  queue.size += packer.count();
}

// In float32: areas of boxes may exceed integers, and need not be sharp.
HWY_INLINE V samples(const Boxes& box) {
  const D d;
  const V one = hn::Set(d, 1);
  const V width = hn::Add(hn::ConvertTo(d, hn::Sub(box.x1, box.x0)), one);
  const V height = hn::Add(hn::ConvertTo(d, hn::Sub(box.y1, box.y0)), one);
  return hn::Mul(width, height);
}

}  // namespace

void find_boxes(const std::uint32_t* triangles, std::size_t first, std::size_t count, const float* points,
                const BoxRules& rules, BoxQueue* queues) {
  const D d;
  const DU du;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t left = count - i;
    const std::uint32_t* corners = triangles + 3 * (first + i);
    std::uint32_t last[3 * kVertexRoom] = {};
    if (left < lanes) {
      std::copy(corners, corners + 3 * left, last);
      corners = last;
    }
    VU a, b, c;
    hn::LoadInterleaved3(du, corners, a, b, c);
    const Boxes box = boxes_of(rules, gather(points, a), gather(points, b), gather(points, c));
    M open = left < lanes ? hn::And(box.seen, hn::FirstN(d, left)) : box.seen;
    if (hn::AllFalse(d, open)) continue;
    const VU faces = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(first + i)));
    const V size = samples(box);
    for (int q = 0; q < kSmallQueues; ++q) {
      const M fits = hn::And(open, hn::Le(size, hn::Set(d, kQueueSamples[q])));
      if (hn::AllFalse(d, fits)) continue;
      push(queues[q], fits, faces, box);
      open = hn::AndNot(fits, open);
    }
    if (!hn::AllFalse(d, open)) push(queues[kSmallQueues], open, faces, box);
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void find_boxes(const std::uint32_t* triangles, std::size_t first, std::size_t count, const float* points,
                const BoxRules& rules, BoxQueue* queues) {
  FACEMAP_DISPATCH(find_boxes)(triangles, first, count, points, rules, queues);
}

}  // namespace facemap::simd
#endif
