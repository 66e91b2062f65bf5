// Where rows of samples enter and leave faces. Included once a target, as foreach_target.h has it.
#include "simd/nearest_lanes-inl.h"

#if defined(FACEMAP_NEAREST_SPANS) == defined(HWY_TARGET_TOGGLE)
#ifdef FACEMAP_NEAREST_SPANS
#undef FACEMAP_NEAREST_SPANS
#else
#define FACEMAP_NEAREST_SPANS
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

constexpr float kFlat = 0x1p-60f;   // edges that rise less a sample bound no row
constexpr float kBeyond = 0x1p30f;  // samples: more than any row has

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

}  // namespace
}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
