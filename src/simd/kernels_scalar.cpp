#include "simd/kernels.h"

namespace facemap::simd {
namespace {

float dot(const float m[3], const float d[3]) { return m[0] * d[0] + m[1] * d[1] + m[2] * d[2]; }

// No as soon as one edge surely fails; written so that a NaN leaves kUndecided.
Verdict cone_verdict(const FacePlanes& p, const float d[3], float length) {
  const float bound = p.edge_error * length + kUnderflow;
  const float e0 = dot(p.edge[0], d), e1 = dot(p.edge[1], d), e2 = dot(p.edge[2], d);
  if (e0 < -bound || e1 < -bound || e2 < -bound) return kNo;
  return e0 > bound && e1 > bound && e2 > bound ? kYes : kUndecided;
}

// The plane first: most entries of a light's list fail it.
Verdict block_verdict(const FacePlanes& p, const float D[3], float length) {
  const float bound = p.normal_error * length + p.offset_error + kUnderflow;
  const float beyond = dot(p.normal, D) - p.offset;
  if (beyond < -bound) return kNo;
  const Verdict cone = cone_verdict(p, D, length);
  if (cone == kNo) return kNo;
  return beyond > bound && cone == kYes ? kYes : kUndecided;
}

}  // namespace

void cone_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const float d[3],
                   float length, Verdict* verdicts) {
  for (std::size_t i = 0; i < count; ++i) verdicts[i] = cone_verdict(planes[ids[i]], d, length);
}

BlockWalk find_blocker(const FacePlanes* planes, const float* nearest, const std::uint32_t* ids, std::size_t count,
                       const float D[3], float length, float reach, std::uint32_t skip, std::uint32_t* undecided) {
  BlockWalk walk;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = ids[i];
    if (nearest[id] > reach) break;
    if (id == skip) continue;
    ++walk.tested;
    const Verdict verdict = block_verdict(planes[id], D, length);
    if (verdict == kYes) {
      walk.blocked = true;
      return walk;
    }
    if (verdict == kUndecided) undecided[walk.undecided++] = id;
  }
  return walk;
}

}  // namespace facemap::simd
