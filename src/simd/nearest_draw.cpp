#include "simd/nearest_draw.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_draw.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

constexpr std::size_t kRoom = kBlockFaces;  // a vector's lanes at most
constexpr float kInverseSharpness = 0x1p-17f;

// An upper bound of w, from the errors that `sharp` stands for; none if it is never sharp.
HWY_INLINE V largest_w(V w, V sharp) {
  const D d;
  const V more = hn::Mul(hn::Abs(w), hn::Set(d, kSharpShare));
  const V bound = hn::Add(hn::Add(w, more), hn::Mul(sharp, hn::Set(d, kInverseSharpness * 1.0001f)));
  return hn::IfThenElse(hn::Lt(sharp, hn::Set(d, kNeverSharp)), bound,
                        hn::Set(d, std::numeric_limits<float>::infinity()));
}

// The lanes of `which` are pairs left open, those not in `inside` because the ray may miss the face.
HWY_INLINE void draw_unsure_lanes(const RasterTarget& target, M which, M inside, V w, V sharp, VI samples, VI faces) {
  const D d;
  const DI di;
  alignas(64) float bounds[kRoom];
  alignas(64) std::int32_t at[kRoom], ids[kRoom];
  const VI flag = hn::Set(di, std::numeric_limits<std::int32_t>::min());
  const VI named = hn::IfThenElse(hn::RebindMask(di, inside), faces, hn::Or(faces, flag));
  hn::CompressStore(largest_w(w, sharp), which, d, bounds);
  hn::CompressStore(named, hn::RebindMask(di, which), di, ids);
  const std::size_t count = hn::CompressStore(samples, hn::RebindMask(di, which), di, at);
  for (std::size_t i = 0; i < count; ++i) {
    draw_unsure(target, {static_cast<std::uint32_t>(at[i]), static_cast<std::uint32_t>(ids[i]), bounds[i]});
  }
}

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
      const M inside = hn::And(near, hn::Ge(e, one));
      const M sure = hn::And(inside, hn::Ge(w, sharp));
      alignas(64) float ws[kRoom];
      alignas(64) std::int32_t at[kRoom], who[kRoom];
      hn::CompressStore(w, sure, d, ws);
      hn::CompressStore(faces, hn::RebindMask(di, sure), di, who);
      const std::size_t count = hn::CompressStore(samples, hn::RebindMask(di, sure), di, at);
      for (std::size_t i = 0; i < count; ++i) draw_sample(target, static_cast<std::uint32_t>(at[i]), ws[i], who[i]);
      const M unsure = hn::AndNot(sure, near);
      if (!hn::AllFalse(d, unsure)) draw_unsure_lanes(target, unsure, inside, w, sharp, samples, faces);
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
  const DI di;
  const V e0 = hn::Add(hn::Mul(hn::Set(d, p.A[0]), dx), hn::Set(d, p.base[0]));
  const V e1 = hn::Add(hn::Mul(hn::Set(d, p.A[1]), dx), hn::Set(d, p.base[1]));
  const V e2 = hn::Add(hn::Mul(hn::Set(d, p.A[2]), dx), hn::Set(d, p.base[2]));
  const V e = hn::Min(hn::Min(e0, e1), e2);
  const M near = hn::And(live, hn::Ge(e, hn::Set(d, -1)));
  if (hn::AllFalse(d, near)) return;
  const V w = hn::Add(hn::Mul(hn::Set(d, p.A[3]), dx), hn::Set(d, p.base[3]));
  const M inside = hn::And(near, hn::Ge(e, hn::Set(d, 1)));
  const V sharp = hn::Set(d, p.sharp);
  const M sure = hn::And(inside, hn::Ge(w, sharp));

  // The last samples of a row are copied, so that nothing beyond it is touched.
  alignas(64) float last_w[kRoom] = {};
  alignas(64) std::int32_t last_faces[kRoom] = {};
  const bool is_whole = count >= hn::Lanes(d);
  float* ws = target.w + first;
  std::int32_t* ids = target.faces + first;
  if (!is_whole) {
    std::copy(ws, ws + count, last_w);
    std::copy(ids, ids + count, last_faces);
    ws = last_w;
    ids = last_faces;
  }
  const V old_w = hn::LoadU(d, ws);
  const VI old_ids = hn::LoadU(di, ids);
  const VI new_ids = hn::Set(di, static_cast<std::int32_t>(id));
  const M front = hn::And(sure, hn::Gt(w, old_w));
  const VI apart = hn::Sub(hn::BitCast(di, w), hn::BitCast(di, old_w));
  const auto close = hn::And(hn::Lt(hn::Abs(apart), hn::Set(di, kCloseUlps + 1)), hn::Gt(old_ids, hn::Set(di, -1)));
  hn::StoreU(hn::IfThenElse(front, w, old_w), d, ws);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(di, front), new_ids, old_ids), di, ids);
  if (!is_whole) {
    std::copy(last_w, last_w + count, target.w + first);
    std::copy(last_faces, last_faces + count, target.faces + first);
  }

  const VI samples = hn::Add(hn::Set(di, static_cast<std::int32_t>(first)), hn::Iota(di, 0));
  const M contested = hn::And(sure, hn::RebindMask(d, close));
  if (!hn::AllFalse(d, contested)) {
    const V loser_w = hn::IfThenElse(front, old_w, w);
    const VI losers = hn::IfThenElse(hn::RebindMask(di, front), old_ids, new_ids);
    draw_unsure_lanes(target, contested, contested, loser_w, hn::Zero(d), samples, losers);
  }
  const M unsure = hn::AndNot(sure, near);
  if (!hn::AllFalse(d, unsure)) draw_unsure_lanes(target, unsure, inside, w, sharp, samples, new_ids);
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
