// Vectors of three coordinates, a lane each: of any kind of lanes. Included once a target, as foreach_target.h has it.
#if defined(FACEMAP_SIMD_VECTORS) == defined(HWY_TARGET_TOGGLE)
#ifdef FACEMAP_SIMD_VECTORS
#undef FACEMAP_SIMD_VECTORS
#else
#define FACEMAP_SIMD_VECTORS
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

// Bounds of rounding errors count these operations, and answers are to be the same in every kernel: sums are taken from
// left to right, as in math/dvector.h.
template <class V>
struct Vector3 {
  V x, y, z;
};

template <class V>
HWY_INLINE Vector3<V> operator-(const Vector3<V>& a, const Vector3<V>& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
HWY_INLINE Vector3<V> cross(const Vector3<V>& a, const Vector3<V>& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

template <class V>
HWY_INLINE V dot(const Vector3<V>& a, const Vector3<V>& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class V>
HWY_INLINE V sum_of_sizes(const Vector3<V>& a) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Add(hn::Add(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z));
}

}  // namespace
}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
