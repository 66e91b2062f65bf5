// What kernels that draw faces share. Included once a target, as foreach_target.h has it.
#include <algorithm>
#include <limits>

#include "simd/nearest_planes.h"
#include "simd/nearest_target.h"

#if defined(FACEMAP_NEAREST_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef FACEMAP_NEAREST_LANES
#undef FACEMAP_NEAREST_LANES
#else
#define FACEMAP_NEAREST_LANES
#endif

#include <hwy/highway.h>

#include "simd/pack-inl.h"

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
static_assert(kBlockSide == 4 && kBlockSamples == kRoom);

// Where the samples of a block stand in it.
alignas(64) constexpr float kColumnsInBlock[kRoom] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kRowsInBlock[kRoom] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

constexpr float kInverseSharpness = 0x1p-17f;

// Coefficients of faces in lanes or of one face in all.
struct LanePlanes {
  V A[3], B[3], C[3], Aw, Bw, Cw, sharp;
};

HWY_INLINE LanePlanes load(const FaceBlock& block, std::size_t from) {
  const D d;
  LanePlanes p;
  for (int k = 0; k < 3; ++k) {
    p.A[k] = hn::Load(d, block.A[k] + from);
    p.B[k] = hn::Load(d, block.B[k] + from);
    p.C[k] = hn::Load(d, block.C[k] + from);
  }
  p.Aw = hn::Load(d, block.Aw + from);
  p.Bw = hn::Load(d, block.Bw + from);
  p.Cw = hn::Load(d, block.Cw + from);
  p.sharp = hn::Load(d, block.sharp + from);
  return p;
}

HWY_INLINE LanePlanes broadcast(const FaceBlock& block, std::size_t k) {
  const D d;
  LanePlanes p;
  for (int i = 0; i < 3; ++i) {
    p.A[i] = hn::Set(d, block.A[i][k]);
    p.B[i] = hn::Set(d, block.B[i][k]);
    p.C[i] = hn::Set(d, block.C[i][k]);
  }
  p.Aw = hn::Set(d, block.Aw[k]);
  p.Bw = hn::Set(d, block.Bw[k]);
  p.Cw = hn::Set(d, block.Cw[k]);
  p.sharp = hn::Set(d, block.sharp[k]);
  return p;
}

// first, first + 1, ...: steps that are a constant are not put together lane by lane, as Iota does it.
HWY_INLINE V counted_from(float first) {
  const D d;
  return hn::Add(hn::Iota(d, 0), hn::Set(d, first));
}

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

HWY_INLINE void draw_fragments(const RasterTarget& target) {
  Fragments& f = *target.fragments;
  const RasterTarget t = target;  // of its own: nothing that is stored may change it
  const std::size_t count = f.count;
  for (std::size_t i = 0; i < count; ++i) draw_sample(t, static_cast<std::uint32_t>(f.samples[i]), f.w[i], f.faces[i]);
  f.count = 0;
}

// Fragments of different faces, in any samples: `near` lanes are not surely outside, `inside` ones surely inside.
HWY_INLINE void draw_scattered(const RasterTarget& target, M near, M inside, V w, V sharp, VI samples, VI faces) {
  const D d;
  const M sure = hn::And(inside, hn::Ge(w, sharp));
  Fragments& f = *target.fragments;
  const std::size_t n = f.count;
  const Packer<D> packer(sure);
  packer.store(w, f.w + n);
  packer.store(faces, f.faces + n);
  packer.store(samples, f.samples + n);
  f.count = n + packer.count();
  if (f.count > Fragments::kRoom - kRoom) draw_fragments(target);
  const M unsure = hn::AndNot(sure, near);
  if (!hn::AllFalse(d, unsure)) draw_unsure_lanes(target, unsure, inside, w, sharp, samples, faces);
}

// Fragments of one face in the samples of a block from `first` on, as many as there are lanes.
HWY_INLINE void draw_in_block(const RasterTarget& target, M near, M inside, V w, V sharp, std::uint32_t first,
                              VI face) {
  const D d;
  const DI di;
  const M sure = hn::And(inside, hn::Ge(w, sharp));
  const V old_w = hn::Load(d, target.w + first);
  const VI old_faces = hn::Load(di, target.faces + first);
  const M front = hn::And(sure, hn::Gt(w, old_w));
  const VI apart = hn::Sub(hn::BitCast(di, w), hn::BitCast(di, old_w));
  const M close = hn::RebindMask(d, hn::Lt(hn::Abs(apart), hn::Set(di, static_cast<std::int32_t>(kCloseUlps) + 1)));
  hn::Store(hn::IfThenElse(front, w, old_w), d, target.w + first);
  hn::Store(hn::IfThenElse(hn::RebindMask(di, front), face, old_faces), di, target.faces + first);

  const M contested = hn::And(hn::And(sure, close), hn::Gt(old_w, hn::Zero(d)));
  const M unsure = hn::AndNot(sure, near);
  if (hn::AllFalse(d, hn::Or(contested, unsure))) return;
  const VI samples = hn::Add(hn::Set(di, static_cast<std::int32_t>(first)), hn::Iota(di, 0));
  const V loser_w = hn::IfThenElse(front, old_w, w);
  const VI losers = hn::IfThenElse(hn::RebindMask(di, front), old_faces, face);
  draw_unsure_lanes(target, contested, contested, loser_w, hn::Zero(d), samples, losers);
  draw_unsure_lanes(target, unsure, inside, w, sharp, samples, face);
}

// The number of a sample is the sum of these of its row and of its column.
HWY_INLINE VI row_part(VI row, std::uint32_t row_samples) {
  const DI di;
  const VI block = hn::Mul(hn::ShiftRight<2>(row), hn::Set(di, static_cast<std::int32_t>(row_samples)));
  return hn::Add(block, hn::ShiftLeft<2>(hn::And(row, hn::Set(di, 3))));
}
HWY_INLINE VI column_part(VI column) {
  const VI before = hn::And(column, hn::Set(DI(), ~3));  // columns of blocks before its own: 4 samples each
  return hn::Add(column, hn::Add(before, hn::ShiftLeft<1>(before)));
}

}  // namespace
}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
