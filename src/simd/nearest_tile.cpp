#include "simd/nearest_tile.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_tile.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/nearest_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

// Rounding of a cap's centre and of the sums to float32, all of size 1.
constexpr double kCapRounding = 0x1p-20;

HWY_INLINE V value(V A, V B, V C, V u, V v) { return hn::Add(hn::Mul(A, u), hn::Add(hn::Mul(B, v), C)); }

HWY_INLINE V least_value(const LanePlanes& p, V u, V v) {
  return hn::Min(hn::Min(value(p.A[0], p.B[0], p.C[0], u, v), value(p.A[1], p.B[1], p.C[1], u, v)),
                 value(p.A[2], p.B[2], p.C[2], u, v));
}

HWY_INLINE void draw_lanes(const FaceBlock& block, const FaceBoxes& boxes, std::size_t from, const TilePoints& points,
                           const RasterTarget& target) {
  const D d;
  const DI di;
  alignas(64) std::int32_t first[kRoom] = {}, ids[kRoom] = {}, step_down[kRoom] = {};
  alignas(64) float width[kRoom] = {}, height[kRoom];
  std::fill(height, height + kRoom, -1.0f);
  for (std::size_t i = 0; i < hn::Lanes(d) && from + i < boxes.count; ++i) {
    const std::size_t k = from + i;
    const auto columns = static_cast<std::int32_t>(target.columns);
    first[i] = boxes.y0[k] * columns + boxes.x0[k];
    ids[i] = static_cast<std::int32_t>(boxes.faces[k]);
    width[i] = static_cast<float>(boxes.x1[k] - boxes.x0[k]);
    height[i] = static_cast<float>(boxes.y1[k] - boxes.y0[k]);
    step_down[i] = columns - (boxes.x1[k] - boxes.x0[k]);
  }
  const LanePlanes p = load(block, from);
  const V one = hn::Set(d, 1), last_dx = hn::Load(d, width), last_dy = hn::Load(d, height);
  const VI faces = hn::Load(di, ids), down = hn::Load(di, step_down), right = hn::Set(di, 1);
  VI samples = hn::Load(di, first);
  V dx = hn::Zero(d), dy = hn::Zero(d);
  M live = hn::Le(dy, last_dy);
  while (!hn::AllFalse(d, live)) {
    const VI at = hn::IfThenElseZero(hn::RebindMask(di, live), samples);
    const V u = hn::GatherIndex(d, points.u, at), v = hn::GatherIndex(d, points.v, at);
    const V e = least_value(p, u, v);
    const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
    if (!hn::AllFalse(d, near)) {
      const V w = value(p.Aw, p.Bw, p.Cw, u, v);
      draw_scattered(target, near, hn::And(near, hn::Ge(e, one)), w, p.sharp, samples, faces);
    }
    dx = hn::Add(dx, one);
    const M at_end = hn::Gt(dx, last_dx);
    dx = hn::IfThenZeroElse(at_end, dx);
    dy = hn::IfThenElse(at_end, hn::Add(dy, one), dy);
    samples = hn::Add(samples, hn::IfThenElse(hn::RebindMask(di, at_end), down, right));
    live = hn::And(live, hn::Le(dy, last_dy));
  }
}

using DD = hn::ScalableTag<double>;
using VD = hn::Vec<DD>;

HWY_INLINE VD dot(const double axis[3], VD x, VD y, VD z) {
  const DD d;
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, axis[0]), x), hn::Mul(hn::Set(d, axis[1]), y)),
                 hn::Mul(hn::Set(d, axis[2]), z));
}

}  // namespace

double find_tile_points(const double axes[3][3], double per_radian, const float* x, const float* y, const float* z,
                        std::size_t count, float* u, float* v) {
  const DD d;
  const hn::Rebind<float, DD> floats;
  VD reach = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const VD dx = hn::PromoteTo(d, hn::LoadU(floats, x + i));
    const VD dy = hn::PromoteTo(d, hn::LoadU(floats, y + i));
    const VD dz = hn::PromoteTo(d, hn::LoadU(floats, z + i));
    const VD scale = hn::Div(hn::Set(d, per_radian), dot(axes[2], dx, dy, dz));
    const VD at_u = hn::Mul(dot(axes[0], dx, dy, dz), scale), at_v = hn::Mul(dot(axes[1], dx, dy, dz), scale);
    reach = hn::Max(reach, hn::Max(hn::Abs(at_u), hn::Abs(at_v)));
    hn::StoreU(hn::DemoteTo(floats, at_u), floats, u + i);
    hn::StoreU(hn::DemoteTo(floats, at_v), floats, v + i);
  }
  alignas(64) double reaches[kRoom];
  hn::Store(reach, d, reaches);
  return *std::max_element(reaches, reaches + hn::Lanes(d));
}

void draw_tile_faces(const FaceBlock& block, const FaceBoxes& boxes, const TilePoints& points,
                     const RasterTarget& target) {
  for (std::size_t i = 0; i < boxes.count; i += hn::Lanes(D())) draw_lanes(block, boxes, i, points, target);
}

void draw_tile_rows(const FaceBlock& block, const FaceBoxes& boxes, std::size_t k, const TilePoints& points,
                    const RasterTarget& target) {
  const D d;
  const LanePlanes p = broadcast(block, k);
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  for (std::int32_t y = boxes.y0[k]; y <= boxes.y1[k]; ++y) {
    for (std::int32_t x = boxes.x0[k]; x <= boxes.x1[k]; x += lanes) {
      const std::uint32_t first = static_cast<std::uint32_t>(y) * target.columns + static_cast<std::uint32_t>(x);
      const V u = hn::LoadU(d, points.u + first), v = hn::LoadU(d, points.v + first);
      const V e = least_value(p, u, v);
      const M live = hn::FirstN(d, static_cast<std::size_t>(std::min(lanes, boxes.x1[k] - x + 1)));
      const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
      if (hn::AllFalse(d, near)) continue;
      const V w = value(p.Aw, p.Bw, p.Cw, u, v);
      draw_neighbours(target, near, hn::And(near, hn::Ge(e, hn::Set(d, 1))), w, p.sharp, first, kBlockFaces,
                      boxes.faces[k]);
    }
  }
}

std::size_t find_tiles(const LargeFace& face, const TileCaps& caps, std::uint32_t* tiles) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  // Unit normals, and the slack that the bound of the edge's value asks for; an edge without one rejects nothing.
  float A[3], B[3], C[3], slack[3];
  for (int k = 0; k < 3; ++k) {
    const double length = std::sqrt(face.A[k] * face.A[k] + face.B[k] * face.B[k] + face.C[k] * face.C[k]);
    const double scale = length > 1 ? 1 / length : 0;
    A[k] = static_cast<float>(face.A[k] * scale);
    B[k] = static_cast<float>(face.B[k] * scale);
    C[k] = static_cast<float>(face.C[k] * scale);
    slack[k] = static_cast<float>(scale + kCapRounding);
  }
  std::size_t found = 0;
  for (std::size_t i = 0; i < caps.count; i += hn::Lanes(d)) {
    const V x = hn::LoadU(d, caps.x + i), y = hn::LoadU(d, caps.y + i), z = hn::LoadU(d, caps.z + i);
    const V sine = hn::LoadU(d, caps.sine + i);
    M meets = hn::FirstN(d, std::min(hn::Lanes(d), caps.count - i));
    for (int k = 0; k < 3; ++k) {
      const V e =
          hn::Add(hn::Add(hn::Mul(hn::Set(d, A[k]), x), hn::Mul(hn::Set(d, B[k]), y)), hn::Mul(hn::Set(d, C[k]), z));
      meets = hn::And(meets, hn::Ge(hn::Add(e, hn::Set(d, slack[k])), hn::Neg(sine)));
    }
    if (hn::AllFalse(d, meets)) continue;
    const auto ids = hn::Iota(du, static_cast<std::uint32_t>(i));
    found += hn::CompressStore(ids, hn::RebindMask(du, meets), du, tiles + found);
  }
  return found;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

double find_tile_points(const double axes[3][3], double per_radian, const float* x, const float* y, const float* z,
                        std::size_t count, float* u, float* v) {
  return FACEMAP_DISPATCH(find_tile_points)(axes, per_radian, x, y, z, count, u, v);
}

void draw_tile_faces(const FaceBlock& block, const FaceBoxes& boxes, const TilePoints& points,
                     const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_tile_faces)(block, boxes, points, target);
}

void draw_tile_rows(const FaceBlock& block, const FaceBoxes& boxes, std::size_t k, const TilePoints& points,
                    const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_tile_rows)(block, boxes, k, points, target);
}

std::size_t find_tiles(const LargeFace& face, const TileCaps& caps, std::uint32_t* tiles) {
  return FACEMAP_DISPATCH(find_tiles)(face, caps, tiles);
}

}  // namespace facemap::simd
#endif
