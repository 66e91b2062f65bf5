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

HWY_INLINE Local local_of(const VertexFrame& f, const float* positions) {
  const D d;
  V x, y, z;
  hn::LoadInterleaved3(d, positions, x, y, z);
  x = hn::Sub(x, hn::Set(d, f.origin[0]));
  y = hn::Sub(y, hn::Set(d, f.origin[1]));
  z = hn::Sub(z, hn::Set(d, f.origin[2]));
  const V length = hn::Mul(hn::Set(d, f.unit), hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)));
  return {row(f.rows[0], x, y, z), row(f.rows[1], x, y, z), row(f.rows[2], x, y, z), length};
}

HWY_INLINE void store(const VertexFrame& f, const Local& p, V u, V v, M has_point, float* points) {
  const D d;
  if (!hn::AllTrue(d, has_point)) u = hn::IfThenElse(has_point, u, outside_codes(f, p));
  hn::StoreInterleaved2(u, v, d, points);
}

HWY_INLINE void project(const VertexFrame& f, const float* positions, float* points) {
  const D d;
  const Local p = local_of(f, positions);
  const V reach = hn::Mul(hn::Set(d, f.limit), p.Z);
  const M has_point =
      hn::And(hn::Ge(p.Z, hn::Set(d, kLeastDepth)), hn::And(hn::Le(hn::Abs(p.X), reach), hn::Le(hn::Abs(p.Y), reach)));
  store(f, p, hn::Div(p.X, p.Z), hn::Div(p.Y, p.Z), has_point, points);
}

// The angle of (z, distance), distance >= 0.
HWY_INLINE V angle_of(V distance, V z) {
  const D d;
  const V size = hn::Abs(z);
  const M is_steep = hn::Gt(distance, size);
  const V t = hn::Div(hn::Min(distance, size), hn::Max(distance, size)), s = hn::Mul(t, t);
  V p = hn::Set(d, 0.0028662257f);
  p = hn::Sub(hn::Mul(p, s), hn::Set(d, 0.0161657367f));
  p = hn::Add(hn::Mul(p, s), hn::Set(d, 0.0429096138f));
  p = hn::Sub(hn::Mul(p, s), hn::Set(d, 0.0752896400f));
  p = hn::Add(hn::Mul(p, s), hn::Set(d, 0.1065626393f));
  p = hn::Sub(hn::Mul(p, s), hn::Set(d, 0.1420889944f));
  p = hn::Add(hn::Mul(p, s), hn::Set(d, 0.1999355085f));
  p = hn::Sub(hn::Mul(p, s), hn::Set(d, 0.3333314528f));
  const V least = hn::Add(t, hn::Mul(hn::Mul(t, s), p));
  const V acute = hn::IfThenElse(is_steep, hn::Sub(hn::Set(d, 1.57079633f), least), least);
  return hn::IfThenElse(hn::Lt(z, hn::Zero(d)), hn::Sub(hn::Set(d, 3.14159265f), acute), acute);
}

HWY_INLINE void project_surface(const SurfaceFrame& f, const float* positions, float* points) {
  const D d;
  const Local p = local_of(f.frame, positions);
  const V distance = hn::Sqrt(hn::Add(hn::Mul(p.X, p.X), hn::Mul(p.Y, p.Y)));
  const V per_radian = hn::Set(d, f.per_radian), z = hn::Mul(p.Z, per_radian);
  const V angle = angle_of(distance, z);
  // On the axis (u, v) is 0 whatever the factor. Comparisons with what overflowed are false.
  const M off_axis = hn::Gt(distance, hn::Zero(d));
  const V factor = hn::IfThenElseZero(off_axis, hn::Div(hn::Mul(angle, per_radian), distance));
  const M in_range = hn::And(hn::Ge(p.length, hn::Set(d, kLeastLength)), hn::Le(p.length, hn::Set(d, kLargestLength)));
  const M has_point = hn::And(in_range, hn::Le(angle, hn::Set(d, f.largest_angle)));
  store(f.frame, p, hn::Mul(p.X, factor), hn::Mul(p.Y, factor), has_point, points);
}

}  // namespace

void project_vertices(const float* positions, std::size_t count, const VertexFrame& frame, float* points) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) project(frame, positions + 3 * i, points + 2 * i);
  if (i == count) return;
  float last[3 * kVertexRoom] = {};
  std::copy(positions + 3 * i, positions + 3 * count, last);
  float points_of_last[2 * kVertexRoom];
  project(frame, last, points_of_last);
  std::copy(points_of_last, points_of_last + 2 * (count - i), points + 2 * i);
}

void project_vertices_surface(const float* positions, std::size_t count, const SurfaceFrame& frame, float* points) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) project_surface(frame, positions + 3 * i, points + 2 * i);
  if (i == count) return;
  float last[3 * kVertexRoom] = {};
  std::copy(positions + 3 * i, positions + 3 * count, last);
  float points_of_last[2 * kVertexRoom];
  project_surface(frame, last, points_of_last);
  std::copy(points_of_last, points_of_last + 2 * (count - i), points + 2 * i);
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void project_vertices(const float* positions, std::size_t count, const VertexFrame& frame, float* points) {
  FACEMAP_DISPATCH(project_vertices)(positions, count, frame, points);
}

void project_vertices_surface(const float* positions, std::size_t count, const SurfaceFrame& frame, float* points) {
  FACEMAP_DISPATCH(project_vertices_surface)(positions, count, frame, points);
}

}  // namespace facemap::simd
#endif
