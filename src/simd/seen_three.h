// Vectors of three coordinates in double precision, a lane each, in the order of operations of math/dvector.h.
// Included once a target, inside the kernels' files.
#if defined(FACEMAP_SIMD_SEEN_THREE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACEMAP_SIMD_SEEN_THREE_H_
#undef FACEMAP_SIMD_SEEN_THREE_H_
#else
#define FACEMAP_SIMD_SEEN_THREE_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;
using Floats = hn::Rebind<float, D>;
using Integers = hn::Rebind<std::int32_t, D>;
using Places = hn::Rebind<std::int64_t, D>;

HWY_INLINE V constant(double x) { return hn::Set(D(), x); }
HWY_INLINE V promoted(const float* p) { return hn::PromoteTo(D(), hn::LoadU(Floats(), p)); }
HWY_INLINE V load(const double* p) { return hn::LoadU(D(), p); }
HWY_INLINE void store(V v, double* p) { hn::StoreU(v, D(), p); }
HWY_INLINE void store_integers(V v, std::int32_t* p) { hn::StoreU(hn::DemoteTo(Integers(), v), Integers(), p); }

// std::max(a, b), NaN and zeros included.
HWY_INLINE V standard_max(V a, V b) { return hn::IfThenElse(hn::Lt(a, b), b, a); }

using Three = Vector3<V>;

HWY_INLINE Three all(double x) { return {constant(x), constant(x), constant(x)}; }
HWY_INLINE Three point(const float p[3]) { return {constant(p[0]), constant(p[1]), constant(p[2])}; }
HWY_INLINE Three point(const double p[3]) { return {constant(p[0]), constant(p[1]), constant(p[2])}; }

// Rows of a structure of arrays, from element i on.
template <std::size_t kCount>
HWY_INLINE Three load(const double (*rows)[kCount], std::size_t i) {
  return {load(rows[0] + i), load(rows[1] + i), load(rows[2] + i)};
}
template <std::size_t kCount>
HWY_INLINE Three promoted(const float (*rows)[kCount], std::size_t i) {
  return {promoted(rows[0] + i), promoted(rows[1] + i), promoted(rows[2] + i)};
}
template <std::size_t kCount>
HWY_INLINE void store(const Three& v, double (*rows)[kCount], std::size_t i) {
  store(v.x, rows[0] + i);
  store(v.y, rows[1] + i);
  store(v.z, rows[2] + i);
}
template <std::size_t kCount>
HWY_INLINE Three gather(const double (*rows)[kCount], hn::Vec<Places> places) {
  return {hn::GatherIndex(D(), rows[0], places), hn::GatherIndex(D(), rows[1], places),
          hn::GatherIndex(D(), rows[2], places)};
}

HWY_INLINE Three plus(const Three& a, const Three& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Three minus(const Three& a, const Three& b) { return a - b; }
HWY_INLINE Three times(const Three& a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
HWY_INLINE Three magnitude(const Three& a) { return {hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)}; }
HWY_INLINE Three chosen(Mask m, const Three& yes, const Three& no) {
  return {hn::IfThenElse(m, yes.x, no.x), hn::IfThenElse(m, yes.y, no.y), hn::IfThenElse(m, yes.z, no.z)};
}

// The largest magnitude, as std::max gives it.
HWY_INLINE V largest_of(const Three& a) {
  const Three size = magnitude(a);
  return standard_max(standard_max(size.x, size.y), size.z);
}

// As normalized() of math/dvector.h; `has_length` where it is not zero.
HWY_INLINE Three normalized(const Three& a, Mask* has_length) {
  const V largest = largest_of(a);
  *has_length = hn::Gt(largest, hn::Zero(D()));
  const Three scaled = {hn::Div(a.x, largest), hn::Div(a.y, largest), hn::Div(a.z, largest)};
  const V length = hn::Sqrt(dot(scaled, scaled));
  const Three unit = {hn::Div(scaled.x, length), hn::Div(scaled.y, length), hn::Div(scaled.z, length)};
  return {hn::IfThenElseZero(*has_length, unit.x), hn::IfThenElseZero(*has_length, unit.y),
          hn::IfThenElseZero(*has_length, unit.z)};
}

}  // namespace
}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once a target
