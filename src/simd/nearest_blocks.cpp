#include "simd/nearest_blocks.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/nearest_spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

// Blocks from (first_dx, first_dy) on, and what is drawn of them: columns left..right, rows top..bottom. Where dx and
// dy count from may stand inside a block.
struct BlockRow {
  float first_dx, first_dy, left, right, top, bottom;
  std::uint32_t first;  // number of the first block's first sample
  std::uint32_t count;  // blocks
};

HWY_INLINE void draw_block_row(const LanePlanes& p, const BlockRow& row, VI face, const RasterTarget& target) {
  const D d;
  const V left = hn::Set(d, row.left), right = hn::Set(d, row.right), side = hn::Set(d, float{kBlockSide});
  for (std::size_t i = 0; i < kBlockSamples; i += hn::Lanes(d)) {
    const V dy = hn::Add(hn::Set(d, row.first_dy), hn::Load(d, kRowsInBlock + i));
    const M in_rows = hn::And(hn::Ge(dy, hn::Set(d, row.top)), hn::Le(dy, hn::Set(d, row.bottom)));
    if (hn::AllFalse(d, in_rows)) continue;
    V values[4];
    row_values(p, dy, values);
    V dx = hn::Add(hn::Set(d, row.first_dx), hn::Load(d, kColumnsInBlock + i));
    std::uint32_t at = row.first + static_cast<std::uint32_t>(i);
    for (std::uint32_t k = 0; k < row.count; ++k, at += kBlockSamples, dx = hn::Add(dx, side)) {
      const V e = hn::Min(hn::Min(hn::Add(hn::Mul(p.A[0], dx), values[0]), hn::Add(hn::Mul(p.A[1], dx), values[1])),
                          hn::Add(hn::Mul(p.A[2], dx), values[2]));
      const M live = hn::And(in_rows, hn::And(hn::Ge(dx, left), hn::Le(dx, right)));
      const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
      if (hn::AllFalse(d, near)) continue;
      const V w = hn::Add(hn::Mul(p.Aw, dx), values[3]);
      draw_in_block(target, near, hn::And(near, hn::Ge(e, hn::Set(d, 1))), w, p.sharp, at, face);
    }
  }
}

// The columns of a row of blocks that some of its rows may see.
struct Columns {
  float low, high;
};

// Those of four rows of blocks from first_dy on.
HWY_INLINE void find_columns(const LanePlanes& p, const Spans& spans, float first_dy, float top, float bottom,
                             V last_dx, Columns columns[kBlockSide]) {
  const D d;
  alignas(64) float low[kRoom], high[kRoom];
  for (std::size_t i = 0; i < kRoom; i += hn::Lanes(d)) {
    const V dy = counted_from(first_dy + static_cast<float>(i));
    V values[4];
    row_values(p, dy, values);
    const Span span = span_at(spans, values, last_dx);
    const M in_rows = hn::And(hn::Ge(dy, hn::Set(d, top)), hn::Le(dy, hn::Set(d, bottom)));
    hn::Store(hn::IfThenElse(in_rows, span.low, hn::Set(d, kBeyond)), d, low + i);
    hn::Store(hn::IfThenElse(in_rows, span.high, hn::Set(d, -1)), d, high + i);
  }
  for (std::size_t k = 0; k < kBlockSide; ++k) {
    const float *l = low + k * kBlockSide, *h = high + k * kBlockSide;
    columns[k] = {std::min(std::min(l[0], l[1]), std::min(l[2], l[3])),
                  std::max(std::max(h[0], h[1]), std::max(h[2], h[3]))};
  }
}

HWY_INLINE void draw_one(const FaceBlock& block, const FaceBoxes& boxes, std::size_t k, const RasterTarget& target) {
  const DI di;
  const LanePlanes p = broadcast(block, k);
  const Spans spans = spans_of(p);
  const std::int32_t x0 = boxes.x0[k], y0 = boxes.y0[k];
  const std::int32_t top = std::max(y0, target.first_row), bottom = std::min(boxes.y1[k], target.last_row);
  BlockRow row;
  row.left = 0;
  row.right = static_cast<float>(boxes.x1[k] - x0);
  row.top = static_cast<float>(top - y0);
  row.bottom = static_cast<float>(bottom - y0);
  const V last_dx = hn::Set(D(), row.right);
  const VI face = hn::Set(di, static_cast<std::int32_t>(boxes.faces[k]));
  Columns columns[kBlockSide] = {};
  const std::int32_t first = top & ~(kBlockSide - 1);
  for (std::int32_t y = first; y <= bottom; y += kBlockSide) {
    const std::int32_t which = (y - first) / kBlockSide % kBlockSide;
    row.first_dy = static_cast<float>(y - y0);
    if (which == 0) find_columns(p, spans, row.first_dy, row.top, row.bottom, last_dx, columns);
    const Columns& c = columns[which];
    if (!(c.low <= c.high)) continue;
    const std::int32_t begin = (x0 + static_cast<std::int32_t>(c.low)) & ~(kBlockSide - 1);
    const std::int32_t end = x0 + static_cast<std::int32_t>(c.high);
    row.first_dx = static_cast<float>(begin - x0);
    row.first = sample_at(target.row_samples, begin, y);
    row.count = static_cast<std::uint32_t>(end - begin) / kBlockSide + 1;
    draw_block_row(p, row, face, target);
  }
}

// ---- large faces ----

struct Run {
  double low, high;  // both ends inside; empty if low > high
};

// Samples of a row that are not surely outside: where all three values reach -1, with a unit to spare for roundings.
HWY_INLINE Run run_of(const LargeFace& face, const double inverse[3], const double values[3], const SampleBox& box,
                      double first_u) {
  Run run = {static_cast<double>(box.x0), static_cast<double>(box.x1)};
  for (int k = 0; k < 3; ++k) {
    if (face.A[k] == 0) {
      if (values[k] < -2) return {0, -1};
      continue;
    }
    const double limit = -(values[k] + 2) * inverse[k] - first_u;
    if (face.A[k] > 0) {
      run.low = std::max(run.low, limit - 0.125);
    } else {
      run.high = std::min(run.high, limit + 0.125);
    }
  }
  if (!(run.low <= run.high)) return {0, -1};
  return {std::ceil(run.low), std::floor(run.high)};
}

HWY_INLINE float rounded(double x) { return static_cast<float>(std::min(std::max(x, -0x1p100), 0x1p100)); }

// (u, v): the first sample of the first block.
HWY_INLINE LanePlanes planes_at(const LargeFace& face, double u, double v) {
  const D d;
  LanePlanes p;
  V* const A[4] = {&p.A[0], &p.A[1], &p.A[2], &p.Aw};
  V* const B[4] = {&p.B[0], &p.B[1], &p.B[2], &p.Bw};
  V* const C[4] = {&p.C[0], &p.C[1], &p.C[2], &p.Cw};
  for (int k = 0; k < 4; ++k) {
    *A[k] = hn::Set(d, rounded(face.A[k]));
    *B[k] = hn::Set(d, rounded(face.B[k]));
    *C[k] = hn::Set(d, rounded(face.A[k] * u + (face.B[k] * v + face.C[k])));
  }
  p.sharp = hn::Set(d, face.sharp);
  return p;
}

// Columns begin..end of the rows top..bottom of a row of blocks.
HWY_INLINE void draw_strips(const LargeFace& face, VI id, std::int32_t begin, std::int32_t end, std::int32_t top,
                            std::int32_t bottom, double first_u, double first_v, const RasterTarget& target) {
  const std::int32_t y = top & ~(kBlockSide - 1);
  for (std::int32_t x = begin & ~(kBlockSide - 1); x <= end; x += kLargeRun) {
    const std::int32_t last = std::min(x + kLargeRun - 1, end);
    BlockRow row;
    row.first_dx = row.first_dy = 0;
    row.left = static_cast<float>(std::max(begin - x, 0));
    row.right = static_cast<float>(last - x);
    row.top = static_cast<float>(top - y);
    row.bottom = static_cast<float>(bottom - y);
    row.first = sample_at(target.row_samples, x, y);
    row.count = static_cast<std::uint32_t>(last - x) / kBlockSide + 1;
    draw_block_row(planes_at(face, first_u + x, first_v + y), row, id, target);
  }
}

}  // namespace

void draw_wide_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  for (std::size_t k = 0; k < boxes.count; ++k) draw_one(block, boxes, k, target);
}

void draw_large(const LargeFace& face, std::uint32_t id, const SampleBox& box, double first_u, double first_v,
                const RasterTarget& target) {
  double inverse[3];
  for (int k = 0; k < 3; ++k) inverse[k] = 1 / face.A[k];
  const VI face_id = hn::Set(DI(), static_cast<std::int32_t>(id));
  const std::int32_t last = std::min(box.y1, target.last_row);
  for (std::int32_t top = std::max(box.y0, target.first_row); top <= last;) {
    const std::int32_t bottom = std::min(top | (kBlockSide - 1), last);
    double low = kBeyond, high = -1;
    for (std::int32_t y = top; y <= bottom; ++y) {
      double row[3];
      for (int k = 0; k < 3; ++k) row[k] = face.B[k] * (first_v + y) + face.C[k];
      const Run run = run_of(face, inverse, row, box, first_u);
      if (run.low > run.high) continue;
      low = std::min(low, run.low);
      high = std::max(high, run.high);
    }
    if (low <= high) {
      draw_strips(face, face_id, static_cast<std::int32_t>(low), static_cast<std::int32_t>(high), top, bottom, first_u,
                  first_v, target);
    }
    top = bottom + 1;
  }
}

void copy_rows(const RasterTarget& target, std::size_t columns, std::int32_t* faces, std::size_t stride) {
  const hn::CappedTag<float, kBlockSide> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto none = hn::Set(di, -1);
  for (std::int32_t row = target.first_row; row <= target.last_row; ++row) {
    const std::size_t first = sample_at(target.row_samples, 0, row);
    std::int32_t* out = faces + static_cast<std::size_t>(row) * stride;
    const auto copy = [&](std::size_t column, std::int32_t* to) HWY_ATTR {
      const std::size_t at = first + column * kBlockSide;
      for (std::size_t i = 0; i < kBlockSide; i += hn::Lanes(d)) {
        const auto seen = hn::Gt(hn::Load(d, target.w + at + i), hn::Zero(d));
        // What is not read need not come from memory.
        const auto ids = hn::AllFalse(d, seen) ? none : hn::Load(di, target.faces + at + i);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(di, seen), ids, none), di, to + i);
      }
    };
    std::size_t column = 0;
    for (; column + kBlockSide <= columns; column += kBlockSide) copy(column, out + column);
    if (column == columns) continue;
    std::int32_t last[kBlockSide];
    copy(column, last);
    std::copy(last, last + (columns - column), out + column);
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void draw_wide_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_wide_faces)(block, boxes, target);
}

void draw_large(const LargeFace& face, std::uint32_t id, const SampleBox& box, double first_u, double first_v,
                const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_large)(face, id, box, first_u, first_v, target);
}

void copy_rows(const RasterTarget& target, std::size_t columns, std::int32_t* faces, std::size_t stride) {
  FACEMAP_DISPATCH(copy_rows)(target, columns, faces, stride);
}

}  // namespace facemap::simd
#endif
