#include "simd/hub_planes.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/hub_planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/vectors-inl.h"

#ifndef FACEMAP_SIMD_HUB_PLANES_ONCE
#define FACEMAP_SIMD_HUB_PLANES_ONCE
namespace facemap::simd {

// With u = 2^-24, A, B, C the first corner from the hub and the edges from it to the others, |x| the sum of a vector's
// components' sizes and ||x|| the greatest: differences of floats are off by u each, so a component of a cross product
// of x and y by 4 u of its two terms, all three together by 4 u |x| |y|. D w is off by 2 u, w being exact by
// definition. A plane's factor costs u, three products and two sums 3 u: a product with D w is off by 10 u of |A| |B|,
// |A| |C| and |B| |C|. The third edge, the difference of three such, by all of them and by two roundings: 12 u. The
// rest is for what is of second order, the bound's own roundings included.
inline constexpr float kHubEdgeError = 14 * 0x1p-24f;

// normal . D w is off by 10 u |B| |C|, and times `scale` by 12 u; the height by 8 u |B| |C| ||A||, with its factor and
// the product with w by 10 u; their difference by one rounding more of each.
inline constexpr float kHubPlaneError = 14 * 0x1p-24f;

// Bounds outside these are not for float32, nor is a height from a determinant below the least. Underflow then loses
// less than 2^-30 of a bound: some 2^-149 of a determinant, times w, where the bound has kHubPlaneError 2^-90 / 3 w.
inline constexpr float kLeastHubBound = 0x1p-90f;
inline constexpr float kGreatestHubBound = 0x1p90f;

}  // namespace facemap::simd
#endif

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
// Of this file alone: the same names stand for other lanes elsewhere.
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using Vector = Vector3<VF>;

constexpr std::size_t kLanes = hn::MaxLanes(DF());
constexpr std::size_t kFaces = FacePack::kFaces;
constexpr std::size_t kParts = kFaces / kLanes;

HWY_INLINE VF greatest_size(const Vector& a) { return hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); }

HWY_INLINE std::uint32_t bits_of(hn::Mask<DF> mask) {
#if HWY_TARGET <= HWY_AVX3
  return static_cast<std::uint32_t>(mask.raw);
#else
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(DF(), mask, bytes);
  return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
#endif
}

HWY_INLINE Vector corner(const FacePack& faces, std::size_t k, std::size_t i) {
  const DF d;
  return {hn::Load(d, faces.corners[k][0] + i), hn::Load(d, faces.corners[k][1] + i),
          hn::Load(d, faces.corners[k][2] + i)};
}

// 1 / bound, or 0 where the bound is not for float32.
HWY_INLINE VF inverse_of(VF bound) {
  const DF d;
  const auto is_usable =
      hn::And(hn::Ge(bound, hn::Set(d, kLeastHubBound)), hn::Le(bound, hn::Set(d, kGreatestHubBound)));
  return hn::IfThenElseZero(is_usable, hn::Div(hn::Set(d, 1.0f), hn::IfThenElse(is_usable, bound, hn::Set(d, 1.0f))));
}

HWY_INLINE void store(const Vector& v, VF factor, std::size_t i, float (*to)[kFaces]) {
  const DF d;
  hn::Store(hn::Mul(v.x, factor), d, to[0] + i);
  hn::Store(hn::Mul(v.y, factor), d, to[1] + i);
  hn::Store(hn::Mul(v.z, factor), d, to[2] + i);
}

HWY_INLINE std::uint32_t set_up_some(const FacePack& faces, const Vector& hub, std::size_t i, HubPlanes& planes) {
  const DF d;
  const Vector a = corner(faces, 0, i);
  const Vector A = a - hub, B = corner(faces, 1, i) - a, C = corner(faces, 2, i) - a;
  const Vector normal = cross(B, C), ab = cross(A, B), ca = cross(C, A);
  const auto determinant = dot(normal, A);

  const auto size_b = sum_of_sizes(B), size_c = sum_of_sizes(C), reach = greatest_size(A);
  const auto area = hn::Mul(size_b, size_c);
  const auto edges = hn::Add(hn::Mul(sum_of_sizes(A), hn::Add(size_b, size_c)), area);
  const auto edge_bound = hn::Mul(edges, hn::Set(d, kHubEdgeError));
  const auto plane_bound = hn::Mul(area, hn::Set(d, kHubPlaneError));

  const auto size = hn::Abs(determinant);
  const auto is_sure = hn::And(hn::Gt(size, hn::Mul(plane_bound, reach)), hn::Ge(size, hn::Set(d, kLeastHubBound)));
  const auto sign = hn::Set(d, -0.0f);
  const auto turn = hn::IfThenElseZero(is_sure, hn::And(sign, determinant));  // of a face turned towards the hub
  const auto factor = hn::Xor(inverse_of(edge_bound), turn);
  const auto plane_factor = inverse_of(plane_bound);
  store(ab, factor, i, planes.ab);
  store(ca, factor, i, planes.ca);
  store(normal, factor, i, planes.normal);
  // 0 if either bound, or their quotient, is not for float32. Of a determinant below the least, underflow may have
  // taken more than a bound allows, once it is divided by one and multiplied by w, which is up to 1 /
  // kLeastHubDistance.
  const auto scale = hn::Mul(edge_bound, plane_factor);
  const auto is_usable = hn::And(hn::Ge(size, hn::Set(d, kLeastHubBound)),
                                 hn::And(hn::Ne(factor, hn::Zero(d)), hn::Le(scale, hn::Set(d, kGreatestHubBound))));
  hn::Store(hn::IfThenElseZero(is_usable, scale), d, planes.scale + i);
  hn::Store(hn::IfThenElseZero(is_usable, hn::Mul(hn::Xor(determinant, turn), plane_factor)), d, planes.height + i);
  hn::Store(reach, d, planes.reach + i);
  return bits_of(hn::Not(is_sure)) & ((1u << kLanes) - 1);
}

HWY_INLINE void aim_some(const Vector& hub, const float* x, const float* y, const float* z, std::size_t i,
                         const HubTargets& targets) {
  const DF d;
  const Vector D = Vector{hn::LoadU(d, x + i), hn::LoadU(d, y + i), hn::LoadU(d, z + i)} - hub;
  const auto size = greatest_size(D), least = hn::Set(d, kLeastHubDistance);
  const auto is_there = hn::Ge(size, least);
  const auto w = hn::Div(hn::Set(d, 1.0f), hn::Max(size, least));
  hn::StoreU(hn::Mul(D.x, w), d, targets.x + i);
  hn::StoreU(hn::Mul(D.y, w), d, targets.y + i);
  hn::StoreU(hn::Mul(D.z, w), d, targets.z + i);
  hn::StoreU(hn::IfThenElse(is_there, w, hn::Set(d, kNoHubTarget)), d, targets.w + i);
}

struct Values {
  VF inside;  // the least of three
  VF beyond, bound;
};

// Of a face a lane.
struct LoadedPlanes {
  Vector ab, ca, normal;
  VF scale, height, reach;
};

HWY_INLINE LoadedPlanes loaded(const HubPlanes& planes, std::size_t i) {
  const DF d;
  const auto vector = [&](const float(*from)[kFaces]) HWY_ATTR {
    return Vector{hn::Load(d, from[0] + i), hn::Load(d, from[1] + i), hn::Load(d, from[2] + i)};
  };
  return {vector(planes.ab),
          vector(planes.ca),
          vector(planes.normal),
          hn::Load(d, planes.scale + i),
          hn::Load(d, planes.height + i),
          hn::Load(d, planes.reach + i)};
}

HWY_INLINE Values values_of(const LoadedPlanes& face, const Vector& D, VF w) {
  const DF d;
  const auto n = dot(face.normal, D), first = dot(face.ab, D), second = dot(face.ca, D);
  const auto third = hn::Sub(hn::Sub(n, first), second);
  return {hn::Min(first, hn::Min(second, third)), hn::Sub(hn::Mul(n, face.scale), hn::Mul(face.height, w)),
          hn::Add(hn::Mul(face.reach, w), hn::Set(d, 1.0f))};
}

}  // namespace

std::uint32_t set_up_hub_planes(const FacePack& faces, const float* hub, HubPlanes& planes) {
  const DF d;
  const Vector from{hn::Set(d, hub[0]), hn::Set(d, hub[1]), hn::Set(d, hub[2])};
  std::uint32_t open = 0;
  for (std::size_t i = 0; i < kFaces; i += kLanes) open |= set_up_some(faces, from, i, planes) << i;
  return open;
}

void aim_at(const float* hub, const float* x, const float* y, const float* z, std::size_t count,
            const HubTargets& targets) {
  const DF d;
  const Vector from{hn::Set(d, hub[0]), hn::Set(d, hub[1]), hn::Set(d, hub[2])};
  for (std::size_t i = 0; i < count; i += kLanes) aim_some(from, x, y, z, i, targets);
}

std::size_t ask_pack(const HubPlanes& planes, std::uint32_t pack, const HubTargets& targets,
                     const std::uint32_t* own_places, const std::uint32_t* places, std::size_t count,
                     HubVerdict* verdicts) {
  const DF d;
  const auto one = hn::Set(d, 1.0f), minus_one = hn::Set(d, -1.0f);
  LoadedPlanes faces[kParts];
  for (std::size_t p = 0; p < kParts; ++p) faces[p] = loaded(planes, p * kLanes);
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t place = places[k];
    const Vector D{hn::Set(d, targets.x[place]), hn::Set(d, targets.y[place]), hn::Set(d, targets.z[place])};
    const auto w = hn::Set(d, targets.w[place]);
    std::uint32_t yes = 0, maybe = 0;
    for (std::size_t p = 0; p < kParts; ++p) {
      const auto [inside, beyond, bound] = values_of(faces[p], D, w);
      maybe |= bits_of(hn::And(hn::Ge(inside, minus_one), hn::Ge(beyond, hn::Neg(bound)))) << (p * kLanes);
      yes |= bits_of(hn::And(hn::Gt(inside, one), hn::Gt(beyond, bound))) << (p * kLanes);
    }
    const std::uint32_t own = own_places[place], asked = own >> 4 == pack ? ~(1u << (own & 15)) : ~0u;
    verdicts[found] = {place, static_cast<std::uint16_t>(yes & asked),
                       static_cast<std::uint16_t>(maybe & ~yes & asked)};
    found += (maybe & asked) != 0;
  }
  return found;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

std::uint32_t set_up_hub_planes(const FacePack& faces, const float* hub, HubPlanes& planes) {
  return FACEMAP_DISPATCH(set_up_hub_planes)(faces, hub, planes);
}

void turn_plane(HubPlanes& planes, std::size_t face) {
  for (auto* plane : {planes.ab, planes.ca, planes.normal}) {
    for (int i = 0; i < 3; ++i) plane[i][face] = -plane[i][face];
  }
  planes.height[face] = -planes.height[face];
}

void remove_plane(HubPlanes& planes, std::size_t face) {
  for (auto* plane : {planes.ab, planes.ca, planes.normal}) {
    for (int i = 0; i < 3; ++i) plane[i][face] = 0;
  }
  planes.scale[face] = planes.reach[face] = 0;
  planes.height[face] = 0x1p120f;
}

void aim_at(const float* hub, const float* x, const float* y, const float* z, std::size_t count,
            const HubTargets& targets) {
  FACEMAP_DISPATCH(aim_at)(hub, x, y, z, count, targets);
}

std::size_t ask_pack(const HubPlanes& planes, std::uint32_t pack, const HubTargets& targets,
                     const std::uint32_t* own_places, const std::uint32_t* places, std::size_t count,
                     HubVerdict* verdicts) {
  return FACEMAP_DISPATCH(ask_pack)(planes, pack, targets, own_places, places, count, verdicts);
}

}  // namespace facemap::simd
#endif
