#include "simd/nearest_draw.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_draw.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/nearest_spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

// Boxes in lanes, (dx, dy) counted from their first samples, cut to the target's rows; none live if they are beyond.
struct LaneBoxes {
  VI faces, x0, x1, row;  // `row`: that of dy
  V dy, last_dx, last_dy;
  M live;
};

HWY_INLINE LaneBoxes load(const FaceBoxes& boxes, std::size_t from, const RasterTarget& target) {
  const D d;
  const DI di;
  const VI y0 = hn::LoadU(di, boxes.y0 + from), y1 = hn::LoadU(di, boxes.y1 + from);
  const VI bottom = hn::Min(y1, hn::Set(di, target.last_row));
  LaneBoxes b;
  b.x0 = hn::LoadU(di, boxes.x0 + from);
  b.x1 = hn::LoadU(di, boxes.x1 + from);
  b.row = hn::Max(y0, hn::Set(di, target.first_row));
  b.faces = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(boxes.faces) + from);
  b.dy = hn::ConvertTo(d, hn::Sub(b.row, y0));
  b.last_dx = hn::ConvertTo(d, hn::Sub(b.x1, b.x0));
  b.last_dy = hn::ConvertTo(d, hn::Sub(bottom, y0));
  const std::size_t left = boxes.count - from;
  b.live = hn::Le(b.dy, b.last_dy);
  if (left < hn::Lanes(d)) b.live = hn::And(b.live, hn::FirstN(d, left));
  return b;
}

// Sample by sample over whole boxes.
HWY_INLINE void draw_boxes(const LanePlanes& p, const LaneBoxes& b, const RasterTarget& target) {
  const D d;
  const DI di;
  const V one = hn::Set(d, 1);
  const VI step = hn::Set(di, 1);
  VI column = b.x0, row = b.row;
  V dx = hn::Zero(d), dy = b.dy;
  M live = b.live;
  while (!hn::AllFalse(d, live)) {
    const V e0 = hn::Add(hn::Mul(p.A[0], dx), hn::Add(hn::Mul(p.B[0], dy), p.C[0]));
    const V e1 = hn::Add(hn::Mul(p.A[1], dx), hn::Add(hn::Mul(p.B[1], dy), p.C[1]));
    const V e2 = hn::Add(hn::Mul(p.A[2], dx), hn::Add(hn::Mul(p.B[2], dy), p.C[2]));
    const V e = hn::Min(hn::Min(e0, e1), e2);
    const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
    if (!hn::AllFalse(d, near)) {
      const V w = hn::Add(hn::Mul(p.Aw, dx), hn::Add(hn::Mul(p.Bw, dy), p.Cw));
      const VI samples = hn::Add(row_part(row, target.row_samples), column_part(column));
      draw_scattered(target, near, hn::And(near, hn::Ge(e, one)), w, p.sharp, samples, b.faces);
    }
    dx = hn::Add(dx, one);
    column = hn::Add(column, step);
    const M at_end = hn::Gt(dx, b.last_dx);
    const auto down = hn::RebindMask(di, at_end);
    dx = hn::IfThenZeroElse(at_end, dx);
    column = hn::IfThenElse(down, b.x0, column);
    dy = hn::IfThenElse(at_end, hn::Add(dy, one), dy);
    row = hn::IfThenElse(down, hn::Add(row, step), row);
    live = hn::And(live, hn::Le(dy, b.last_dy));
  }
}

// Sample by sample over the spans of each row.
HWY_INLINE void draw_spans(const LanePlanes& p, const LaneBoxes& b, const RasterTarget& target) {
  const D d;
  const DI di;
  const V one = hn::Set(d, 1);
  const Spans spans = spans_of(p);
  VI row = b.row, row_start = row_part(row, target.row_samples);
  V dy = b.dy, values[4];
  row_values(p, dy, values);
  Span span = span_at(spans, values, b.last_dx);
  V dx = span.low;
  M live = b.live;
  while (!hn::AllFalse(d, live)) {
    const V e = hn::Min(hn::Min(hn::Add(hn::Mul(p.A[0], dx), values[0]), hn::Add(hn::Mul(p.A[1], dx), values[1])),
                        hn::Add(hn::Mul(p.A[2], dx), values[2]));
    const M near = hn::And(hn::And(live, hn::Le(dx, span.high)), hn::Ge(e, hn::Set(d, -1)));
    if (!hn::AllFalse(d, near)) {
      const V w = hn::Add(hn::Mul(p.Aw, dx), values[3]);
      const VI column = hn::Add(b.x0, hn::ConvertTo(di, hn::Min(dx, b.last_dx)));
      const VI samples = hn::Add(row_start, column_part(column));
      draw_scattered(target, near, hn::And(near, hn::Ge(e, one)), w, p.sharp, samples, b.faces);
    }
    dx = hn::Add(dx, one);
    const M at_end = hn::Gt(dx, span.high);
    if (hn::AllFalse(d, at_end)) continue;
    dy = hn::IfThenElse(at_end, hn::Add(dy, one), dy);
    row = hn::Add(row, hn::IfThenElseZero(hn::RebindMask(di, at_end), hn::Set(di, 1)));
    row_start = row_part(row, target.row_samples);
    live = hn::And(live, hn::Le(dy, b.last_dy));
    row_values(p, dy, values);
    const Span next = span_at(spans, values, b.last_dx);
    dx = hn::IfThenElse(at_end, next.low, dx);
    span.high = next.high;
  }
}

}  // namespace

void draw_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  for (std::size_t i = 0; i < boxes.count; i += hn::Lanes(D())) {
    draw_boxes(load(block, i), load(boxes, i, target), target);
  }
}

void draw_thin_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  for (std::size_t i = 0; i < boxes.count; i += hn::Lanes(D())) {
    draw_spans(load(block, i), load(boxes, i, target), target);
  }
}

void draw_waiting(const RasterTarget& target) { draw_fragments(target); }

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void draw_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_faces)(block, boxes, target);
}

void draw_thin_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_thin_faces)(block, boxes, target);
}

void draw_waiting(const RasterTarget& target) { FACEMAP_DISPATCH(draw_waiting)(target); }

}  // namespace facemap::simd
#endif
