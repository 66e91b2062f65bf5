#include "simd/nearest_vertices.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_vertices.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

struct Local {
  V X, Y, Z, length;
};

HWY_INLINE V row(const float m[3], V x, V y, V z) {
  const D d;
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, m[0]), x), hn::Mul(hn::Set(d, m[1]), y)), hn::Mul(hn::Set(d, m[2]), z));
}

HWY_INLINE hn::Vec<DU> code(M surely, std::uint32_t bit) {
  const DU du;
  return hn::IfThenElseZero(hn::RebindMask(du, surely), hn::Set(du, bit));
}

// A comparison with NaN or with an overflowed slack is false: nothing is known then.
HWY_INLINE V outside_codes(const VertexFrame& f, const Local& p) {
  const D d;
  const V reach_u = hn::Mul(hn::Set(d, f.edge_u), p.Z), reach_v = hn::Mul(hn::Set(d, f.edge_v), p.Z);
  const V slack_u = hn::Mul(hn::Set(d, f.slack_u), p.length), slack_v = hn::Mul(hn::Set(d, f.slack_v), p.length);
  auto bits = code(hn::Lt(hn::Add(p.X, reach_u), hn::Neg(slack_u)), kLeft);
  bits = hn::Or(bits, code(hn::Gt(hn::Sub(p.X, reach_u), slack_u), kRight));
  bits = hn::Or(bits, code(hn::Lt(hn::Add(p.Y, reach_v), hn::Neg(slack_v)), kAbove));
  bits = hn::Or(bits, code(hn::Gt(hn::Sub(p.Y, reach_v), slack_v), kBelow));
  bits = hn::Or(bits, code(hn::Lt(p.Z, hn::Neg(hn::Mul(hn::Set(d, f.slack_z), p.length))), kBehind));
  return hn::BitCast(d, hn::Or(bits, hn::Set(DU(), kNoPoint)));
}

HWY_INLINE void project(const VertexFrame& f, const float* positions, float* points) {
  const D d;
  V x, y, z;
  hn::LoadInterleaved3(d, positions, x, y, z);
  x = hn::Sub(x, hn::Set(d, f.origin[0]));
  y = hn::Sub(y, hn::Set(d, f.origin[1]));
  z = hn::Sub(z, hn::Set(d, f.origin[2]));
  const V X = row(f.rows[0], x, y, z), Y = row(f.rows[1], x, y, z), Z = row(f.rows[2], x, y, z);
  const V reach = hn::Mul(hn::Set(d, f.limit), Z);
  const M has_point =
      hn::And(hn::Ge(Z, hn::Set(d, kLeastDepth)), hn::And(hn::Le(hn::Abs(X), reach), hn::Le(hn::Abs(Y), reach)));
  V u = hn::Div(X, Z);
  const V v = hn::Div(Y, Z);
  if (!hn::AllTrue(d, has_point)) {
    const V length = hn::Mul(hn::Set(d, f.unit), hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)));
    u = hn::IfThenElse(has_point, u, outside_codes(f, {X, Y, Z, length}));
  }
  hn::StoreInterleaved2(u, v, d, points);
}

}  // namespace

void project_vertices(const float* positions, std::size_t count, const VertexFrame& frame, float* points) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) project(frame, positions + 3 * i, points + 2 * i);
  if (i == count) return;
  float last[3 * kVertexRoom] = {};
  std::copy(positions + 3 * i, positions + 3 * count, last);
  project(frame, last, points + 2 * i);
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void project_vertices(const float* positions, std::size_t count, const VertexFrame& frame, float* points) {
  FACEMAP_DISPATCH(project_vertices)(positions, count, frame, points);
}

}  // namespace facemap::simd
#endif
