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

// Some faces of a block, from lane `from` on.
HWY_INLINE void draw_lanes(const FaceBlock& block, const FaceBoxes& boxes, std::size_t from,
                           const RasterTarget& target) {
  const D d;
  const DI di;
  alignas(64) std::int32_t first[kRoom] = {}, ids[kRoom] = {}, step_down[kRoom] = {};
  alignas(64) float width[kRoom] = {}, top[kRoom] = {}, bottom[kRoom];
  std::fill(bottom, bottom + kRoom, -1.0f);
  for (std::size_t i = 0; i < hn::Lanes(d) && from + i < boxes.count; ++i) {
    const std::size_t k = from + i;
    if (block.is_unsure[k]) continue;
    const std::int32_t first_row = std::max(boxes.y0[k], target.first_row);
    first[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(first_row) * target.columns +
                                         static_cast<std::uint32_t>(boxes.x0[k]));
    ids[i] = static_cast<std::int32_t>(boxes.faces[k]);
    width[i] = static_cast<float>(boxes.x1[k] - boxes.x0[k]);
    top[i] = static_cast<float>(first_row - boxes.y0[k]);
    bottom[i] = static_cast<float>(std::min(boxes.y1[k], target.last_row) - boxes.y0[k]);
    step_down[i] = static_cast<std::int32_t>(target.columns) - (boxes.x1[k] - boxes.x0[k]);
  }
  const V one = hn::Set(d, 1), last_dx = hn::Load(d, width), last_dy = hn::Load(d, bottom);
  const V A0 = hn::Load(d, block.A[0] + from), A1 = hn::Load(d, block.A[1] + from), A2 = hn::Load(d, block.A[2] + from);
  const V B0 = hn::Load(d, block.B[0] + from), B1 = hn::Load(d, block.B[1] + from), B2 = hn::Load(d, block.B[2] + from);
  const V C0 = hn::Load(d, block.C[0] + from), C1 = hn::Load(d, block.C[1] + from), C2 = hn::Load(d, block.C[2] + from);
  const V Aw = hn::Load(d, block.Aw + from), Bw = hn::Load(d, block.Bw + from), Cw = hn::Load(d, block.Cw + from);
  const V sharp = hn::Load(d, block.sharp + from);
  const VI faces = hn::Load(di, ids), down = hn::Load(di, step_down), right = hn::Set(di, 1);
  VI samples = hn::Load(di, first);
  V dx = hn::Zero(d), dy = hn::Load(d, top);
  M live = hn::Le(dy, last_dy);
  while (!hn::AllFalse(d, live)) {
    const V e0 = hn::Add(hn::Mul(A0, dx), hn::Add(hn::Mul(B0, dy), C0));
    const V e1 = hn::Add(hn::Mul(A1, dx), hn::Add(hn::Mul(B1, dy), C1));
    const V e2 = hn::Add(hn::Mul(A2, dx), hn::Add(hn::Mul(B2, dy), C2));
    const V e = hn::Min(hn::Min(e0, e1), e2);
    const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
    if (!hn::AllFalse(d, near)) {
      const V w = hn::Add(hn::Mul(Aw, dx), hn::Add(hn::Mul(Bw, dy), Cw));
      draw_scattered(target, near, hn::And(near, hn::Ge(e, one)), w, sharp, samples, faces);
    }
    dx = hn::Add(dx, one);
    const M at_end = hn::Gt(dx, last_dx);
    dx = hn::IfThenZeroElse(at_end, dx);
    dy = hn::IfThenElse(at_end, hn::Add(dy, one), dy);
    samples = hn::Add(samples, hn::IfThenElse(hn::RebindMask(di, at_end), down, right));
    live = hn::And(live, hn::Le(dy, last_dy));
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
      draw_vector(planes, hn::Iota(d, static_cast<float>(at - x)), live, first, left, id, target);
    }
  }
}

}  // namespace

void draw_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target) {
  for (std::size_t i = 0; i < boxes.count; i += hn::Lanes(D())) draw_lanes(block, boxes, i, target);
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

void draw_large(const LargeFace& face, std::uint32_t id, const SampleBox& box, double first_u, double first_v,
                const RasterTarget& target) {
  FACEMAP_DISPATCH(draw_large)(face, id, box, first_u, first_v, target);
}

}  // namespace facemap::simd
#endif
