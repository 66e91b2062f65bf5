#include "simd/face_kernels.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/face_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The four planes of one face at once; in pieces where vectors are shorter.
using Tag = hn::CappedTag<float, 4>;
using V = hn::Vec<Tag>;
constexpr std::size_t kPlanes = 4;

struct Direction {
  V x, y, z, length;
};

HWY_INLINE Direction direction_of(const float d[3], float length) {
  const Tag tag;
  return {hn::Set(tag, d[0]), hn::Set(tag, d[1]), hn::Set(tag, d[2]), hn::Set(tag, length)};
}

HWY_INLINE V dot(const FacePlanes& p, std::size_t lane, const Direction& d) {
  const Tag tag;
  const V x = hn::Mul(hn::Load(tag, p.x + lane), d.x);
  const V y = hn::Mul(hn::Load(tag, p.y + lane), d.y);
  const V z = hn::Mul(hn::Load(tag, p.z + lane), d.z);
  return hn::Add(hn::Add(x, y), z);
}

HWY_INLINE hn::Mask<Tag> is_normal(std::size_t lane) {
  const Tag tag;
  return hn::Eq(hn::Iota(tag, static_cast<float>(lane)), hn::Set(tag, 3.0f));
}

// No as soon as one sign is surely wrong, yes if all are surely right; a NaN is neither.
struct Signs {
  bool fails = false, holds = true;

  HWY_INLINE void require(V value, V bound) {
    const Tag tag;
    if (!hn::AllFalse(tag, hn::Lt(value, hn::Neg(bound)))) fails = true;
    if (!hn::AllTrue(tag, hn::Gt(value, bound))) holds = false;
  }
  HWY_INLINE Verdict verdict() const { return fails ? kNo : holds ? kYes : kUndecided; }
};

HWY_INLINE Verdict cone_verdict(const FacePlanes& p, const Direction& d) {
  const Tag tag;
  Signs signs;
  const V bound = hn::Add(hn::Mul(hn::Set(tag, p.error), d.length), hn::Set(tag, kUnderflow));
  const V passes = hn::Set(tag, std::numeric_limits<float>::infinity());
  for (std::size_t lane = 0; lane < kPlanes; lane += hn::Lanes(tag)) {
    signs.require(hn::IfThenElse(is_normal(lane), passes, dot(p, lane, d)), bound);
  }
  return signs.verdict();
}

HWY_INLINE Verdict block_verdict(const FacePlanes& p, const Direction& D) {
  const Tag tag;
  Signs signs;
  const V error = hn::Mul(hn::Set(tag, p.error), D.length);
  for (std::size_t lane = 0; lane < kPlanes; lane += hn::Lanes(tag)) {
    const hn::Mask<Tag> normal = is_normal(lane);
    const V offset_error = hn::IfThenElseZero(normal, hn::Set(tag, p.offset_error));
    const V bound = hn::Add(hn::Add(error, offset_error), hn::Set(tag, kUnderflow));
    const V offset = hn::IfThenElseZero(normal, hn::Set(tag, p.offset));
    signs.require(hn::Sub(dot(p, lane, D), offset), bound);
  }
  return signs.verdict();
}

void cone_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const float d[3],
                   float length, Verdict* verdicts) {
  const Direction direction = direction_of(d, length);
  for (std::size_t i = 0; i < count; ++i) verdicts[i] = cone_verdict(planes[ids[i]], direction);
}

void block_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const ListPoint& point,
                    Verdict* verdicts) {
  const Direction D = direction_of(point.D, point.length);
  for (std::size_t i = 0; i < count; ++i) verdicts[i] = block_verdict(planes[ids[i]], D);
}

BlockWalk find_blocker(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const ListPoint& point,
                       std::uint32_t skip, std::uint32_t* undecided) {
  const Direction D = direction_of(point.D, point.length);
  BlockWalk walk;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = ids[i];
    if (planes[id].nearest > point.reach) {
      walk.ended = true;
      return walk;
    }
    if (id == skip) continue;
    ++walk.tested;
    const Verdict verdict = block_verdict(planes[id], D);
    if (verdict == kYes) {
      walk.blocked = true;
      return walk;
    }
    if (verdict == kUndecided) undecided[walk.undecided++] = id;
  }
  return walk;
}

// The same without a skipped face; kUndecided ends nothing, since a later face may surely block.
HWY_INLINE Verdict walk_list(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count,
                             const ListPoint& point, std::size_t& decided) {
  const Direction D = direction_of(point.D, point.length);
  std::size_t undecided = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = ids[i];
    if (planes[id].nearest > point.reach) count = i;  // the last
    if (i == count) break;
    const Verdict verdict = block_verdict(planes[id], D);
    if (verdict == kYes) {
      decided += i + 1 - undecided;
      return kYes;
    }
    undecided += verdict == kUndecided;
  }
  if (undecided > 0) return kUndecided;
  decided += count;
  return kNo;
}

std::size_t find_blockers(const FacePlanes* planes, const std::uint32_t* const* ids, const std::uint32_t* counts,
                          const ListPoint* points, std::size_t count, Verdict* verdicts) {
  for (std::size_t i = 0; i < count; ++i) {
    for (std::uint32_t k = 0; k < counts[i] && k < 2; ++k) {
      hwy::Prefetch(planes + ids[i][k]);
    }
  }
  std::size_t decided = 0;
  for (std::size_t i = 0; i < count; ++i) verdicts[i] = walk_list(planes, ids[i], counts[i], points[i], decided);
  return decided;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void cone_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const float d[3],
                   float length, Verdict* verdicts) {
  FACEMAP_DISPATCH(cone_verdicts)(planes, ids, count, d, length, verdicts);
}

void block_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const ListPoint& point,
                    Verdict* verdicts) {
  FACEMAP_DISPATCH(block_verdicts)(planes, ids, count, point, verdicts);
}

BlockWalk find_blocker(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const ListPoint& point,
                       std::uint32_t skip, std::uint32_t* undecided) {
  return FACEMAP_DISPATCH(find_blocker)(planes, ids, count, point, skip, undecided);
}

std::size_t find_blockers(const FacePlanes* planes, const std::uint32_t* const* ids, const std::uint32_t* counts,
                          const ListPoint* points, std::size_t count, Verdict* verdicts) {
  return FACEMAP_DISPATCH(find_blockers)(planes, ids, counts, points, count, verdicts);
}

}  // namespace facemap::simd
#endif
