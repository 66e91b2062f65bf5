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
  const VI x0 = hn::LoadU(di, boxes.x0 + from), y0 = hn::LoadU(di, boxes.y0 + from);
  const VI x1 = hn::LoadU(di, boxes.x1 + from), y1 = hn::LoadU(di, boxes.y1 + from);
  const VI faces = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(boxes.faces) + from);
  const LanePlanes p = load(block, from);
  const V one = hn::Set(d, 1);
  const VI step = hn::Set(di, 1);
  VI column = x0, row = y0;
  M live = hn::FirstN(d, std::min(hn::Lanes(d), boxes.count - from));
  while (!hn::AllFalse(d, live)) {
    const VI samples = hn::Add(row_part(row, target.row_samples), column_part(column));
    const VI at = hn::IfThenElseZero(hn::RebindMask(di, live), samples);
    const V u = hn::GatherIndex(d, points.u, at), v = hn::GatherIndex(d, points.v, at);
    const V e = least_value(p, u, v);
    const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
    if (!hn::AllFalse(d, near)) {
      const V w = value(p.Aw, p.Bw, p.Cw, u, v);
      draw_scattered(target, near, hn::And(near, hn::Ge(e, one)), w, p.sharp, samples, faces);
    }
    column = hn::Add(column, step);
    const auto at_end = hn::Gt(column, x1);
    column = hn::IfThenElse(at_end, x0, column);
    row = hn::IfThenElse(at_end, hn::Add(row, step), row);
    live = hn::And(live, hn::RebindMask(d, hn::Not(hn::Gt(row, y1))));
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

void draw_tile_face(const FaceBlock& block, const FaceBoxes& boxes, std::size_t k, const TilePoints& points,
                    const RasterTarget& target) {
  const D d;
  const LanePlanes p = broadcast(block, k);
  const VI face = hn::Set(DI(), static_cast<std::int32_t>(boxes.faces[k]));
  const auto number = [](std::int32_t x) HWY_ATTR { return hn::Set(D(), static_cast<float>(x)); };
  const V left = number(boxes.x0[k]), right = number(boxes.x1[k]);
  const V top = number(boxes.y0[k]), bottom = number(boxes.y1[k]);
  constexpr std::int32_t kMask = ~(kBlockSide - 1);
  for (std::int32_t y = boxes.y0[k] & kMask; y <= boxes.y1[k]; y += kBlockSide) {
    for (std::size_t i = 0; i < kBlockSamples; i += hn::Lanes(d)) {
      const V row = hn::Add(number(y), hn::Load(d, kRowsInBlock + i));
      const M in_rows = hn::And(hn::Ge(row, top), hn::Le(row, bottom));
      if (hn::AllFalse(d, in_rows)) continue;
      for (std::int32_t x = boxes.x0[k] & kMask; x <= boxes.x1[k]; x += kBlockSide) {
        const V column = hn::Add(number(x), hn::Load(d, kColumnsInBlock + i));
        const std::uint32_t at = sample_at(target.row_samples, x, y) + static_cast<std::uint32_t>(i);
        const V u = hn::Load(d, points.u + at), v = hn::Load(d, points.v + at);
        const V e = least_value(p, u, v);
        const M live = hn::And(in_rows, hn::And(hn::Ge(column, left), hn::Le(column, right)));
        const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
        if (hn::AllFalse(d, near)) continue;
        const V w = value(p.Aw, p.Bw, p.Cw, u, v);
        draw_in_block(target, near, hn::And(near, hn::Ge(e, hn::Set(d, 1))), w, p.sharp, at, face);
      }
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

void draw_tile_face(const FaceBlock& block, const FaceBoxes& boxes, std::size_t k, const TilePoints& points,
                    const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_tile_face)(block, boxes, k, points, target);
}

std::size_t find_tiles(const LargeFace& face, const TileCaps& caps, std::uint32_t* tiles) {
  return FACEMAP_DISPATCH(find_tiles)(face, caps, tiles);
}

}  // namespace facemap::simd
#endif
