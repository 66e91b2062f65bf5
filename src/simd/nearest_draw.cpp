#include "simd/nearest_draw.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_draw.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/nearest_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

constexpr float kFlat = 0x1p-60f;   // edges that rise less a sample bound no row
constexpr float kBeyond = 0x1p30f;  // samples: more than any row has

// Boxes in lanes, (dx, dy) counted from their first samples, cut to the target's rows; none live if they are beyond.
struct LaneBoxes {
  VI faces, first;  // `first`: the sample at (0, dy)
  V dy, last_dx, last_dy;
  M live;
};

HWY_INLINE LaneBoxes load(const FaceBoxes& boxes, std::size_t from, const RasterTarget& target) {
  const D d;
  const DI di;
  const VI x0 = hn::LoadU(di, boxes.x0 + from), x1 = hn::LoadU(di, boxes.x1 + from);
  const VI y0 = hn::LoadU(di, boxes.y0 + from), y1 = hn::LoadU(di, boxes.y1 + from);
  const VI top = hn::Max(y0, hn::Set(di, target.first_row)), bottom = hn::Min(y1, hn::Set(di, target.last_row));
  LaneBoxes b;
  b.faces = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(boxes.faces) + from);
  b.first = hn::Add(hn::Mul(top, hn::Set(di, static_cast<std::int32_t>(target.columns))), x0);
  b.dy = hn::ConvertTo(d, hn::Sub(top, y0));
  b.last_dx = hn::ConvertTo(d, hn::Sub(x1, x0));
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
  const VI columns = hn::Set(di, static_cast<std::int32_t>(target.columns)), right = hn::Set(di, 1);
  const VI down = hn::Sub(columns, hn::ConvertTo(di, b.last_dx));
  VI samples = b.first;
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
      draw_scattered(target, near, hn::And(near, hn::Ge(e, one)), w, p.sharp, samples, b.faces);
    }
    dx = hn::Add(dx, one);
    const M at_end = hn::Gt(dx, b.last_dx);
    dx = hn::IfThenZeroElse(at_end, dx);
    dy = hn::IfThenElse(at_end, hn::Add(dy, one), dy);
    samples = hn::Add(samples, hn::IfThenElse(hn::RebindMask(di, at_end), down, right));
    live = hn::And(live, hn::Le(dy, b.last_dy));
  }
}

// Where a row enters and leaves a face: samples beyond are surely outside. An edge's value A dx + b is held against -4,
// not -1: with S = |A| width + |B| height, at most 1/(15 k) by the bound that values are counted in, b is off by 4 k 3
// S and the quotient by 4 k 3 S + 1 if |C| <= 2 S, below 3 together; else the edge cuts no sample of the box from the
// others, and the quotient lies beyond the box, which 1/8 sample keeps it in spite of its rounding.
struct Spans {
  V inverse[3];
  M rises[3], falls[3];
};

HWY_INLINE Spans spans_of(const LanePlanes& p) {
  const D d;
  Spans s;
  for (int k = 0; k < 3; ++k) {
    s.rises[k] = hn::Gt(p.A[k], hn::Set(d, kFlat));
    s.falls[k] = hn::Lt(p.A[k], hn::Set(d, -kFlat));
    s.inverse[k] = hn::Div(hn::Set(d, 1), hn::IfThenElse(hn::Or(s.rises[k], s.falls[k]), p.A[k], hn::Set(d, 1)));
  }
  return s;
}

struct Span {
  V low, high;
};

HWY_INLINE Span span_at(const Spans& s, const V b[3], V last_dx) {
  const D d;
  const V beyond = hn::Set(d, kBeyond);
  V low = hn::Neg(beyond), high = beyond;
  for (int k = 0; k < 3; ++k) {
    const V limit = hn::Mul(hn::Sub(hn::Set(d, -4), b[k]), s.inverse[k]);
    low = hn::Max(low, hn::IfThenElse(s.rises[k], limit, low));
    high = hn::Min(high, hn::IfThenElse(s.falls[k], limit, high));
  }
  const V slack = hn::Set(d, 0.125f);
  return {hn::Max(hn::Ceil(hn::Sub(low, slack)), hn::Zero(d)), hn::Min(hn::Floor(hn::Add(high, slack)), last_dx)};
}

HWY_INLINE void row_values(const LanePlanes& p, V dy, V b[4]) {
  for (int k = 0; k < 3; ++k) b[k] = hn::Add(hn::Mul(p.B[k], dy), p.C[k]);
  b[3] = hn::Add(hn::Mul(p.Bw, dy), p.Cw);
}

// Sample by sample over the spans of each row.
HWY_INLINE void draw_spans(const LanePlanes& p, const LaneBoxes& b, const RasterTarget& target) {
  const D d;
  const DI di;
  const V one = hn::Set(d, 1);
  const VI columns = hn::Set(di, static_cast<std::int32_t>(target.columns));
  const Spans spans = spans_of(p);
  VI row = b.first;
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
      const VI samples = hn::Add(row, hn::ConvertTo(di, hn::Min(dx, b.last_dx)));
      draw_scattered(target, near, hn::And(near, hn::Ge(e, one)), w, p.sharp, samples, b.faces);
    }
    dx = hn::Add(dx, one);
    const M at_end = hn::Gt(dx, span.high);
    if (hn::AllFalse(d, at_end)) continue;
    dy = hn::IfThenElse(at_end, hn::Add(dy, one), dy);
    row = hn::Add(row, hn::IfThenElseZero(hn::RebindMask(di, at_end), columns));
    live = hn::And(live, hn::Le(dy, b.last_dy));
    row_values(p, dy, values);
    const Span next = span_at(spans, values, b.last_dx);
    dx = hn::IfThenElse(at_end, next.low, dx);
    span.high = next.high;
  }
}

// ---- one face, row by row ---------------------------------------------------------------------------------------

HWY_INLINE void draw_row(const LanePlanes& p, float dy, float low, float high, std::uint32_t row, std::size_t left,
                         std::uint32_t id, const RasterTarget& target) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  V values[4];
  row_values(p, hn::Set(d, dy), values);
  const auto begin = static_cast<std::size_t>(low), end = static_cast<std::size_t>(high) + 1;
  for (std::size_t x = begin; x < end; x += lanes) {
    const V dx = counted_from(static_cast<float>(x));
    const V e = hn::Min(hn::Min(hn::Add(hn::Mul(p.A[0], dx), values[0]), hn::Add(hn::Mul(p.A[1], dx), values[1])),
                        hn::Add(hn::Mul(p.A[2], dx), values[2]));
    const M live = hn::Le(dx, hn::Set(d, high));
    const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
    if (hn::AllFalse(d, near)) continue;
    const V w = hn::Add(hn::Mul(p.Aw, dx), values[3]);
    draw_neighbours(target, near, hn::And(near, hn::Ge(e, hn::Set(d, 1))), w, p.sharp,
                    row + static_cast<std::uint32_t>(x), left - x, id);
  }
}

// Spans of as many rows as there are lanes at a time.
HWY_INLINE void draw_one(const FaceBlock& block, const FaceBoxes& boxes, std::size_t k, const RasterTarget& target) {
  const D d;
  const LanePlanes p = broadcast(block, k);
  const Spans spans = spans_of(p);
  const V last_dx = hn::Set(d, static_cast<float>(boxes.x1[k] - boxes.x0[k]));
  const std::int32_t first_row = std::max(boxes.y0[k], target.first_row);
  const std::int32_t last_row = std::min(boxes.y1[k], target.last_row);
  const auto left = static_cast<std::size_t>(target.columns) - static_cast<std::size_t>(boxes.x0[k]);
  alignas(64) float low[kRoom], high[kRoom];
  for (std::int32_t y = first_row; y <= last_row; y += static_cast<std::int32_t>(hn::Lanes(d))) {
    const auto dy = static_cast<float>(y - boxes.y0[k]);
    V values[4];
    row_values(p, counted_from(dy), values);
    const Span span = span_at(spans, values, last_dx);
    hn::Store(span.low, d, low);
    hn::Store(span.high, d, high);
    const auto rows = static_cast<std::size_t>(std::min(last_row - y + 1, static_cast<std::int32_t>(hn::Lanes(d))));
    for (std::size_t i = 0; i < rows; ++i) {
      if (low[i] > high[i]) continue;
      const std::uint32_t row = (static_cast<std::uint32_t>(y) + static_cast<std::uint32_t>(i)) * target.columns +
                                static_cast<std::uint32_t>(boxes.x0[k]);
      draw_row(p, dy + static_cast<float>(i), low[i], high[i], row, left, boxes.faces[k], target);
    }
  }
}

// ---- large faces ------------------------------------------------------------------------------------------------

struct Run {
  std::int32_t x0, x1;  // both ends inside; empty if x0 > x1
};

// Samples of a row that are not surely outside: where all three values reach -1, with a unit to spare for roundings.
HWY_INLINE Run run_of(const LargeFace& face, const double inverse[3], const double values[3], const SampleBox& box,
                      double first_u) {
  double low = box.x0, high = box.x1;
  for (int k = 0; k < 3; ++k) {
    if (face.A[k] == 0) {
      if (values[k] < -2) return {0, -1};
      continue;
    }
    const double limit = -(values[k] + 2) * inverse[k] - first_u;
    if (face.A[k] > 0) {
      low = std::max(low, limit - 0.125);
    } else {
      high = std::min(high, limit + 0.125);
    }
  }
  if (!(low <= high)) return {0, -1};
  return {static_cast<std::int32_t>(std::ceil(low)), static_cast<std::int32_t>(std::floor(high))};
}

// Up to a vector of samples, from `first` on: three values and w of each, given at the run's first sample.
struct RunPlanes {
  float A[4], base[4];
  float sharp;
};

HWY_INLINE void draw_vector(const RunPlanes& p, V dx, M live, std::uint32_t first, std::size_t count, std::uint32_t id,
                            const RasterTarget& target) {
  const D d;
  const V e0 = hn::Add(hn::Mul(hn::Set(d, p.A[0]), dx), hn::Set(d, p.base[0]));
  const V e1 = hn::Add(hn::Mul(hn::Set(d, p.A[1]), dx), hn::Set(d, p.base[1]));
  const V e2 = hn::Add(hn::Mul(hn::Set(d, p.A[2]), dx), hn::Set(d, p.base[2]));
  const V e = hn::Min(hn::Min(e0, e1), e2);
  const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
  if (hn::AllFalse(d, near)) return;
  const V w = hn::Add(hn::Mul(hn::Set(d, p.A[3]), dx), hn::Set(d, p.base[3]));
  draw_neighbours(target, near, hn::And(near, hn::Ge(e, hn::Set(d, 1))), w, hn::Set(d, p.sharp), first, count, id);
}

HWY_INLINE float rounded(double x) { return static_cast<float>(std::min(std::max(x, -0x1p100), 0x1p100)); }

HWY_INLINE void draw_run(const LargeFace& face, std::uint32_t id, const Run& run, std::int32_t y, const double row[4],
                         double first_u, const RasterTarget& target) {
  const D d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  for (std::int32_t x = run.x0; x <= run.x1; x += kLargeRun) {
    RunPlanes planes;
    for (int k = 0; k < 4; ++k) {
      planes.A[k] = rounded(face.A[k]);
      planes.base[k] = rounded(face.A[k] * (first_u + x) + row[k]);
    }
    planes.sharp = face.sharp;
    const std::int32_t end = std::min(x + kLargeRun, run.x1 + 1);
    for (std::int32_t at = x; at < end; at += lanes) {
      const M live = hn::FirstN(d, static_cast<std::size_t>(std::min(lanes, end - at)));
      const std::uint32_t first = static_cast<std::uint32_t>(y) * target.columns + static_cast<std::uint32_t>(at);
      const auto left = static_cast<std::size_t>(target.columns) - static_cast<std::size_t>(at);
      draw_vector(planes, counted_from(static_cast<float>(at - x)), live, first, left, id, target);
    }
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

void draw_wide_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  for (std::size_t k = 0; k < boxes.count; ++k) draw_one(block, boxes, k, target);
}

void draw_large(const LargeFace& face, std::uint32_t id, const SampleBox& box, double first_u, double first_v,
                const RasterTarget& target) {
  double inverse[3];
  for (int k = 0; k < 3; ++k) inverse[k] = 1 / face.A[k];
  const std::int32_t last = std::min(box.y1, target.last_row);
  for (std::int32_t y = std::max(box.y0, target.first_row); y <= last; ++y) {
    double row[4];
    for (int k = 0; k < 4; ++k) row[k] = face.B[k] * (first_v + y) + face.C[k];
    const Run run = run_of(face, inverse, row, box, first_u);
    draw_run(face, id, run, y, row, first_u, target);
  }
}

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

void draw_wide_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_wide_faces)(block, boxes, target);
}

void draw_large(const LargeFace& face, std::uint32_t id, const SampleBox& box, double first_u, double first_v,
                const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_large)(face, id, box, first_u, first_v, target);
}

}  // namespace facemap::simd
#endif
