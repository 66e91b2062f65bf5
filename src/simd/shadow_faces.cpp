#include "simd/shadow_faces.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shadow_faces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/shadow_project-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
using VD = hn::Vec<DD>;
using Mask = hn::Mask<DF>;

// ---- vertices

HWY_INLINE VD row_of(const double* row, VD x, VD y, VD z) {
  const DD d;
  const auto xy = hn::Add(hn::Mul(hn::Set(d, row[0]), x), hn::Mul(hn::Set(d, row[1]), y));
  return hn::Add(xy, hn::Mul(hn::Set(d, row[2]), z));
}

HWY_INLINE void project_some(const ShadowFrame& frame, const float* positions, float* places) {
  const DD d;
  const DHalfF half;
  hn::Vec<DHalfF> px, py, pz;
  hn::LoadInterleaved3(half, positions, px, py, pz);
  const auto x = hn::Sub(hn::PromoteTo(d, px), hn::Set(d, frame.light[0]));
  const auto y = hn::Sub(hn::PromoteTo(d, py), hn::Set(d, frame.light[1]));
  const auto z = hn::Sub(hn::PromoteTo(d, pz), hn::Set(d, frame.light[2]));
  const auto X = row_of(frame.rows[0], x, y, z);
  const auto Y = row_of(frame.rows[1], x, y, z);
  const auto Z = row_of(frame.rows[2], x, y, z);

  const auto size = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
  const auto depth = hn::Abs(Z);
  const auto is_steep = hn::Lt(depth, hn::Mul(size, hn::Set(d, frame.largest * kShadowSteepest)));
  const auto is_wild = hn::Or(hn::Lt(depth, hn::Set(d, kShadowLeastZ)), hn::Gt(depth, hn::Set(d, kShadowGreatestZ)));
  const auto nowhere = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  const auto Z_or_none = hn::IfThenElse(hn::Or(is_steep, is_wild), nowhere, Z);

  const auto w = hn::Div(hn::Set(half, 1.0f), hn::DemoteTo(half, Z_or_none));
  const auto u = hn::Mul(hn::DemoteTo(half, X), w), v = hn::Mul(hn::DemoteTo(half, Y), w);
  hn::StoreInterleaved3(u, v, w, half, places);
}

void project_vertices(const ShadowFrame& frame, const float* positions, std::size_t count, float* places) {
  const std::size_t lanes = hn::Lanes(DD());
  const std::size_t whole = count / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes) project_some(frame, positions + 3 * i, places + 3 * i);
  if (whole == count) return;
  float last[3 * 16] = {};
  std::copy(positions + 3 * whole, positions + 3 * count, last);
  project_some(frame, last, places + 3 * whole);
}

// ---- faces

struct Places {
  VF u, v, w;
};

HWY_INLINE Places places_of(const float* places, VI corner) {
  const DF d;
  const auto at = hn::Add(corner, hn::Add(corner, corner));
  return {hn::GatherIndex(d, places, at), hn::GatherIndex(d, places + 1, at), hn::GatherIndex(d, places + 2, at)};
}

HWY_INLINE VF least(VF a, VF b, VF c) { return hn::Min(a, hn::Min(b, c)); }
HWY_INLINE VF greatest(VF a, VF b, VF c) { return hn::Max(a, hn::Max(b, c)); }

// Least w of the points in the texels from (column0, row0) to (column1, row1), or of more.
HWY_INLINE VF farthest_point(const FarthestPyramid& pyramid, VI column0, VI column1, VI row0, VI row1) {
  const DF d;
  const DI di;
  auto x0 = hn::ShiftRight<FarthestPyramid::kCellColumnsLog2>(column0);
  auto x1 = hn::ShiftRight<FarthestPyramid::kCellColumnsLog2>(column1);
  auto y0 = hn::ShiftRight<FarthestPyramid::kCellRowsLog2>(row0);
  auto y1 = hn::ShiftRight<FarthestPyramid::kCellRowsLog2>(row1);
  // The level at which the box is at most two cells wide and high: one more than the exponent of its extent less 1.
  // Extents are below 2^11, exact as floats.
  const auto extent = hn::Sub(hn::Max(hn::Sub(x1, x0), hn::Sub(y1, y0)), hn::Set(di, 1));
  const auto exponent = hn::Sub(hn::ShiftRight<23>(hn::BitCast(di, hn::ConvertTo(d, extent))), hn::Set(di, 126));
  const auto level =
      hn::Min(hn::IfThenElseZero(hn::Gt(extent, hn::Zero(di)), exponent), hn::Set(di, pyramid.levels - 1));
  x0 = hn::Shr(x0, level);
  x1 = hn::Shr(x1, level);
  y0 = hn::Shr(y0, level);
  y1 = hn::Shr(y1, level);
  const auto first = hn::GatherIndex(di, pyramid.first, level), columns = hn::GatherIndex(di, pyramid.columns, level);
  const auto a = hn::Add(first, hn::Mul(y0, columns)), b = hn::Add(first, hn::Mul(y1, columns));
  return hn::Min(
      hn::Min(hn::GatherIndex(d, pyramid.cells, hn::Add(a, x0)), hn::GatherIndex(d, pyramid.cells, hn::Add(a, x1))),
      hn::Min(hn::GatherIndex(d, pyramid.cells, hn::Add(b, x0)), hn::GatherIndex(d, pyramid.cells, hn::Add(b, x1))));
}

// Whether a triangle in front of the light surely runs clockwise on the raster, which is how a face looks that is
// turned towards the light. Corners within 1.25 of the middle are off by at most 3.5 * 2^-22 (kShadowMargin), the
// differences of two by less than 2^-19 with their own rounding; then the area is off by 2^-19 of the sum of their
// sizes, by twice the square of 2^-19, and by the rounding of two products and their difference. The bound is twice it.
HWY_INLINE Mask is_entry(const Places& a, const Places& b, const Places& c) {
  const DF d;
  const auto reach = greatest(hn::Max(hn::Abs(a.u), hn::Abs(a.v)), hn::Max(hn::Abs(b.u), hn::Abs(b.v)),
                              hn::Max(hn::Abs(c.u), hn::Abs(c.v)));
  const auto bu = hn::Sub(b.u, a.u), bv = hn::Sub(b.v, a.v), cu = hn::Sub(c.u, a.u), cv = hn::Sub(c.v, a.v);
  const auto area = hn::Sub(hn::Mul(bu, cv), hn::Mul(cu, bv));
  const auto sides = hn::Add(hn::Add(hn::Abs(bu), hn::Abs(bv)), hn::Add(hn::Abs(cu), hn::Abs(cv)));
  const auto error = hn::Mul(sides, hn::Add(hn::Mul(sides, hn::Set(d, 0x1p-22f)), hn::Set(d, 0x1p-18f)));
  const auto bound = hn::Add(error, hn::Set(d, 0x1p-36f));
  return hn::And(hn::Lt(area, hn::Neg(bound)), hn::Le(reach, hn::Set(d, 1.25f)));
}

struct Box {
  VF u0, u1, v0, v1;
};

// Whether a box, of few spots, has none with a point in it. Lanes without a box are not to be asked.
HWY_INLINE Mask is_empty(const FacesToSift& from, const Box& box, Mask has_box) {
  constexpr int kMostColumns = 24, kMostRows = 8;  // a row of bits, begun anywhere in a byte, fits 32
  const DI di;
  const DF d;
  const int columns = from.raster.columns * kSpotColumns, rows = from.raster.rows * kSpotRows;
  const auto has = hn::RebindMask(di, has_box);
  const auto x0 = hn::IfThenElseZero(has, texel_of(box.u0, columns)),
             y0 = hn::IfThenElseZero(has, texel_of(box.v0, rows));
  const auto x1 = hn::IfThenElseZero(has, texel_of(box.u1, columns)),
             y1 = hn::IfThenElseZero(has, texel_of(box.v1, rows));
  const auto width = hn::Sub(x1, x0), height = hn::Sub(y1, y0);
  const auto is_small =
      hn::And(has, hn::And(hn::Lt(width, hn::Set(di, kMostColumns)), hn::Lt(height, hn::Set(di, kMostRows))));
  if (hn::AllFalse(di, is_small)) return hn::RebindMask(d, is_small);

  const auto one = hn::Set(di, 1);
  const auto run = hn::Sub(hn::Shl(hn::Set(di, 2), hn::Min(width, hn::Set(di, kMostColumns - 1))), one);
  const auto bits = hn::Shl(run, hn::And(x0, hn::Set(di, 7)));
  const auto* words = reinterpret_cast<const std::int32_t*>(from.occupied);
  auto at = hn::Add(hn::Mul(y0, hn::Set(di, columns / 8)), hn::ShiftRight<3>(x0));
  auto found = hn::Zero(di);
  for (auto left = hn::IfThenElse(is_small, height, hn::Set(di, -1));; left = hn::Sub(left, one)) {
    const auto is_in = hn::Gt(left, hn::Set(di, -1));
    if (hn::AllFalse(di, is_in)) break;
    found = hn::Or(
        found, hn::And(bits, hn::IfThenElseZero(is_in, hn::GatherOffset(di, words, hn::IfThenElseZero(is_in, at)))));
    at = hn::Add(at, hn::Set(di, columns / 8));
  }
  return hn::RebindMask(d, hn::And(is_small, hn::Eq(found, hn::Zero(di))));
}

HWY_INLINE void sift_some(const FacesToSift& from, std::size_t first, const std::uint32_t* corners,
                          const std::uint8_t* skip, std::size_t count, SiftedFaces& to) {
  const DF d;
  const DU du;
  const DI di;
  hn::Vec<DU> i0, i1, i2;
  hn::LoadInterleaved3(du, corners, i0, i1, i2);
  const Places a = places_of(from.places, hn::BitCast(di, i0));
  const Places b = places_of(from.places, hn::BitCast(di, i1));
  const Places c = places_of(from.places, hn::BitCast(di, i2));

  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), margin = hn::Set(d, kShadowMargin);
  const auto is_asked = hn::RebindMask(d, hn::Lt(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(count))));
  // NaN is neither in front nor behind; Min and Max are not to be asked of it.
  const auto is_in_front = hn::And(hn::Gt(a.w, zero), hn::And(hn::Gt(b.w, zero), hn::Gt(c.w, zero)));
  const auto is_behind = hn::And(hn::Lt(a.w, zero), hn::And(hn::Lt(b.w, zero), hn::Lt(c.w, zero)));
  const auto is_across = hn::AndNot(hn::Or(is_in_front, is_behind), is_asked);
  const auto face = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(first)));
  if (!hn::AllFalse(d, is_across)) {
    to.across_count += hn::CompressStore(face, hn::RebindMask(du, is_across), du, to.across + to.across_count);
  }

  const auto u0 = hn::Sub(least(a.u, b.u, c.u), margin), u1 = hn::Add(greatest(a.u, b.u, c.u), margin);
  const auto v0 = hn::Sub(least(a.v, b.v, c.v), margin), v1 = hn::Add(greatest(a.v, b.v, c.v), margin);
  const auto is_on_raster = hn::And(hn::Le(hn::Max(u0, v0), one), hn::Ge(hn::Min(u1, v1), hn::Neg(one)));
  auto is_left = hn::And(hn::And(is_asked, is_in_front), is_on_raster);
  if (hn::AllFalse(d, is_left)) return;
  if (skip != nullptr) {
    const auto may_skip = hn::PromoteTo(du, hn::LoadU(hn::Rebind<std::uint8_t, DU>(), skip));
    const auto is_skipped = hn::And(is_entry(a, b, c), hn::RebindMask(d, hn::Ne(may_skip, hn::Zero(du))));
    is_left = hn::AndNot(is_skipped, is_left);
    if (hn::AllFalse(d, is_left)) return;
  }

  if (from.occupied != nullptr) {
    is_left = hn::AndNot(is_empty(from, {u0, u1, v0, v1}, is_left), is_left);
    if (hn::AllFalse(d, is_left)) return;
  }
  const auto has_box = hn::RebindMask(di, is_left);  // the others may be NaN, which is no index
  const auto x0 = hn::IfThenElseZero(has_box, texel_of(u0, from.raster.columns));
  const auto x1 = hn::IfThenElseZero(has_box, texel_of(u1, from.raster.columns));
  const auto y0 = hn::IfThenElseZero(has_box, texel_of(v0, from.raster.rows));
  const auto y1 = hn::IfThenElseZero(has_box, texel_of(v1, from.raster.rows));
  const auto nearest = hn::Mul(greatest(a.w, b.w, c.w), hn::Set(d, kShadowDepthFactor));
  is_left = hn::And(is_left, hn::Gt(nearest, farthest_point(*from.farthest, x0, x1, y0, y1)));
  if (hn::AllFalse(d, is_left)) return;

  const auto left = hn::RebindMask(du, is_left);
  const auto left_int = hn::RebindMask(di, is_left);
  hn::CompressStore(face, left, du, to.face + to.count);
  hn::CompressStore(hn::Or(x0, hn::ShiftLeft<16>(x1)), left_int, di, to.columns + to.count);
  hn::CompressStore(hn::Or(y0, hn::ShiftLeft<16>(y1)), left_int, di, to.rows + to.count);
  to.count += hn::CompressStore(nearest, is_left, d, to.nearest + to.count);
}

void sift_faces(const FacesToSift& from, SiftedFaces& to) {
  const std::size_t lanes = hn::Lanes(DF());
  to.across_count = 0;
  std::size_t i = from.first;
  for (; i + lanes <= from.last; i += lanes) {
    const std::uint8_t* skip = from.skip_entries == nullptr ? nullptr : from.skip_entries + i;
    sift_some(from, i, from.corners + 3 * i, skip, lanes, to);
  }
  if (i >= from.last) return;
  const std::size_t count = from.last - i;
  std::uint32_t corners[3 * 16] = {};
  std::uint8_t skip[16] = {};
  std::copy(from.corners + 3 * i, from.corners + 3 * from.last, corners);
  if (from.skip_entries != nullptr) std::copy(from.skip_entries + i, from.skip_entries + from.last, skip);
  sift_some(from, i, corners, skip, count, to);
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void project_vertices(const ShadowFrame& frame, const float* positions, std::size_t count, float* places) {
  FACEMAP_DISPATCH(project_vertices)(frame, positions, count, places);
}

void sift_faces(const FacesToSift& from, SiftedFaces& to) { FACEMAP_DISPATCH(sift_faces)(from, to); }

}  // namespace facemap::simd
#endif
