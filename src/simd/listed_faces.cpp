#include "simd/listed_faces.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/listed_faces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/vectors-inl.h"

#ifndef FACEMAP_SIMD_LISTED_FACES_ONCE
#define FACEMAP_SIMD_LISTED_FACES_ONCE
namespace facemap::simd {

// With u = 2^-24, A, B, C the first corner from the light and the edges from it to the others, D the point, |x| the sum
// of a vector's components and ||x|| the greatest: differences of floats are off by u each, so a component of a cross
// product of x and y by 4 u of its two terms, all three together by 4 u |x| |y|. D is off by 2 u |D| in each component,
// which the greatest slack of points allows, and by its rounding: 7 u ||D||. Three products and two sums make 3 u more.
// An edge of A is off by 14 u |A| |B| ||D||; the third, the difference of three such, by that of all of them and two
// roundings.
inline constexpr float kListedEdgeError = 17 * 0x1p-24f;

// The plane: the normal is off by 4 u |B| |C|; D - A by 7 u ||D|| + u ||A||, and by one rounding of itself, at most
// ||A|| + ||D||; and again 3 u.
inline constexpr float kListedPlaneError = 17 * 0x1p-24f;

// What underflow of any product may lose, times lengths of at most 2 kGreatestListedSize each.
inline constexpr float kListedUnderflow = 0x1p-100f;

}  // namespace facemap::simd
#endif

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
// Of this file alone: the same names stand for other lanes elsewhere.
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using DSpots = hn::Rebind<std::uint16_t, DU>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using Vector = Vector3<VF>;

constexpr std::size_t kLanes = hn::MaxLanes(DF());

// Pairs that wait for their test: a point's coordinates are repeated for each of its faces.
struct PairQueue {
  static constexpr std::size_t kEnough = 256;
  static constexpr std::size_t kRoom = kEnough + 32;

  alignas(64) float d[3][kRoom];
  alignas(64) std::uint32_t point[kRoom];
  alignas(64) std::uint32_t face[kRoom];
  std::size_t count = 0;
};

HWY_INLINE VF greatest_size(const Vector& a) { return hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); }

HWY_INLINE hn::Vec<DI> triple(hn::Vec<DI> i) { return hn::Add(hn::Add(i, i), i); }

HWY_INLINE Vector corner(const FaceLists& lists, VU face, std::size_t k) {
  const DF d;
  const DI di;
  const auto* corners = reinterpret_cast<const std::int32_t*>(lists.corners) + k;
  const auto at = triple(hn::GatherIndex(di, corners, triple(hn::BitCast(di, face))));
  return {hn::GatherIndex(d, lists.positions, at), hn::GatherIndex(d, lists.positions + 1, at),
          hn::GatherIndex(d, lists.positions + 2, at)};
}

struct Verdict {
  hn::Mask<DF> yes, no;
};

// Whether the faces stand between the light and the points at D from it.
HWY_INLINE Verdict verdict_on(const FaceLists& lists, VU face, const Vector& D) {
  const DF d;
  const Vector a = corner(lists, face, 0);
  const Vector A = a - Vector{hn::Set(d, lists.light[0]), hn::Set(d, lists.light[1]), hn::Set(d, lists.light[2])};
  const Vector B = corner(lists, face, 1) - a, C = corner(lists, face, 2) - a;
  const Vector normal = cross(B, C);
  const auto along = dot(normal, D), edge_ab = dot(cross(A, B), D), edge_ca = dot(cross(C, A), D);
  const auto edge_bc = hn::Sub(hn::Sub(along, edge_ab), edge_ca);
  const auto height = dot(normal, D - A);

  const auto size_b = sum_of_sizes(B), size_c = sum_of_sizes(C), of_normal = hn::Mul(size_b, size_c);
  const auto of_edges = hn::Add(hn::Mul(sum_of_sizes(A), hn::Add(size_b, size_c)), of_normal);
  const auto far = greatest_size(D), underflow = hn::Set(d, kListedUnderflow);
  const auto edge_bound = hn::Add(hn::Mul(hn::Mul(of_edges, far), hn::Set(d, kListedEdgeError)), underflow);
  const auto plane_bound =
      hn::Add(hn::Mul(hn::Mul(of_normal, hn::Add(greatest_size(A), far)), hn::Set(d, kListedPlaneError)), underflow);

  // All four are positive for a face that is turned away from the light and blocks the point, negative for one turned
  // towards it.
  const auto least = hn::Min(edge_bc, hn::Min(edge_ab, edge_ca));
  const auto greatest = hn::Max(edge_bc, hn::Max(edge_ab, edge_ca));
  const auto is_positive = hn::Gt(least, edge_bound), is_negative = hn::Lt(greatest, hn::Neg(edge_bound));
  const auto is_above = hn::Gt(height, plane_bound), is_below = hn::Lt(height, hn::Neg(plane_bound));
  const auto has_positive = hn::Gt(greatest, edge_bound), has_negative = hn::Lt(least, hn::Neg(edge_bound));
  const auto yes = hn::Or(hn::And(is_positive, is_above), hn::And(is_negative, is_below));
  const auto no = hn::Or(hn::And(has_positive, hn::Or(has_negative, is_below)), hn::And(has_negative, is_above));
  return {yes, no};
}

HWY_INLINE std::uint32_t bits_of(hn::Mask<DU> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(DU(), mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

// Tests all pairs of the queue and empties it. Returns how many were decided.
HWY_INLINE std::uint64_t test_pairs(const FaceLists& lists, PairQueue& queue, std::uint8_t* dark,
                                    std::vector<OpenPair>& open) {
  const DF d;
  const DU du;
  const std::size_t count = queue.count;
  std::fill_n(queue.face + count, kLanes, queue.face[0]);  // what vectors reach
  for (std::size_t i = 0; i < count; ++i) __builtin_prefetch(lists.corners + 3 * std::size_t{queue.face[i]});
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t* corners = lists.corners + 3 * std::size_t{queue.face[i]};
    for (int k = 0; k < 3; ++k) __builtin_prefetch(lists.positions + 3 * std::size_t{corners[k]});
  }
  std::size_t open_count = 0;
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Vector D{hn::Load(d, queue.d[0] + i), hn::Load(d, queue.d[1] + i), hn::Load(d, queue.d[2] + i)};
    const Verdict verdict = verdict_on(lists, hn::Load(du, queue.face + i), D);
    const std::uint32_t there = count - i < kLanes ? (1u << (count - i)) - 1 : (1u << kLanes) - 1;
    const std::uint32_t yes = bits_of(hn::RebindMask(du, verdict.yes)) & there;
    const std::uint32_t neither = bits_of(hn::RebindMask(du, hn::Not(hn::Or(verdict.yes, verdict.no)))) & there;
    for (std::uint32_t bits = yes; bits != 0; bits &= bits - 1) dark[queue.point[i + __builtin_ctz(bits)]] = 1;
    open_count += static_cast<std::size_t>(__builtin_popcount(neither));
    for (std::uint32_t bits = neither; bits != 0; bits &= bits - 1) {
      const std::size_t k = i + __builtin_ctz(bits);
      open.push_back({queue.point[k], queue.face[k]});
    }
  }
  queue.count = 0;
  return count - open_count;
}

// Of the sixteen entries from `at` on, or as many as a vector has: appends those before `end` that the point may ask.
HWY_INLINE std::size_t append_faces(const FaceLists& lists, std::size_t at, std::size_t end, VU spot, VU depth,
                                    VU own_face, PairQueue& queue) {
  const DU du;
  const DSpots ds;
  const auto entry = hn::LoadU(du, lists.entries + at);
  const auto spots = hn::PromoteTo(du, hn::LoadU(ds, lists.spots + at));
  const auto face = hn::And(entry, hn::Set(du, (std::uint32_t{1} << lists.face_bits) - 1));
  const auto is_there = hn::Lt(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(std::min(end - at, kLanes))));
  const auto is_behind = hn::Lt(hn::ShiftRightSame(entry, lists.face_bits), depth);
  const auto is_asked =
      hn::AndNot(hn::Or(is_behind, hn::Eq(face, own_face)), hn::And(is_there, hn::TestBit(spots, spot)));
  return hn::CompressStore(face, is_asked, du, queue.face + queue.count);
}

// Points whose lists are on their way from memory while others are asked.
constexpr std::size_t kAhead = 32;

HWY_INLINE void prefetch_lists(const FaceLists& lists, const PointsToList& points, std::size_t first) {
  const std::size_t last = std::min(first + 2 * kAhead, points.count);
  for (std::size_t p = first + kAhead; p < last; ++p) {
    const std::size_t begin = lists.begins[points.texels[p]];
    __builtin_prefetch(lists.entries + begin);
    __builtin_prefetch(lists.entries + begin + 15);
    __builtin_prefetch(lists.spots + begin);
  }
}

}  // namespace

std::uint64_t ask_lists(const FaceLists& lists, const PointsToList& points, std::uint8_t* dark,
                        std::vector<OpenPair>& open) {
  const DF d;
  const DU du;
  PairQueue queue;
  std::uint64_t decided = 0;
  for (std::size_t p = 0; p < points.count; ++p) {
    if (p % kAhead == 0) prefetch_lists(lists, points, p);
    const std::uint32_t texel = points.texels[p], i = points.numbers[p];
    const std::size_t end = lists.begins[texel + 1];
    std::size_t at = lists.begins[texel];
    if (at == end) continue;
    const auto spot = hn::Set(du, 1u << (points.depths[p] >> 16));
    const auto depth = hn::Set(du, (points.depths[p] & 0xffff) >> lists.depth_shift);
    const auto own_face = hn::Set(du, points.own_faces[i]);
    const auto coordinate = [&](std::size_t k, const std::int32_t* q) HWY_ATTR {
      return hn::Set(d, static_cast<float>(points.offset[k] + points.step * q[i]));
    };
    for (; at < end; at += kLanes) {
      const std::size_t found = append_faces(lists, at, end, spot, depth, own_face, queue);
      if (found == 0) continue;
      hn::StoreU(coordinate(0, points.x), d, queue.d[0] + queue.count);
      hn::StoreU(coordinate(1, points.y), d, queue.d[1] + queue.count);
      hn::StoreU(coordinate(2, points.z), d, queue.d[2] + queue.count);
      hn::StoreU(hn::Set(du, i), du, queue.point + queue.count);
      queue.count += found;
      if (queue.count >= PairQueue::kEnough) decided += test_pairs(lists, queue, dark, open);
    }
  }
  if (queue.count > 0) decided += test_pairs(lists, queue, dark, open);
  return decided;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

std::uint64_t ask_lists(const FaceLists& lists, const PointsToList& points, std::uint8_t* dark,
                        std::vector<OpenPair>& open) {
  return FACEMAP_DISPATCH(ask_lists)(lists, points, dark, open);
}

}  // namespace facemap::simd
#endif
