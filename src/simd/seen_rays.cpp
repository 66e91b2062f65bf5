#include "simd/seen_rays.h"

#include "math/elementary.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/seen_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/seen_three.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

// The operations of Projection::local_from_map, plane, in their order.
HWY_INLINE Three plane_local(V dx, V dy, double texel_angle) {
  const V one = constant(1);
  const V x = hn::Mul(dx, constant(texel_angle)), y = hn::Mul(dy, constant(texel_angle));
  const V scale = hn::Div(one, hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), one)));
  return {hn::Mul(x, scale), hn::Mul(y, scale), scale};
}

// elementary::sin and cos for angles from 0 to pi, in the order of their operations.
struct SinCos {
  V sin, cos;
};

HWY_INLINE V sin_near_zero(V x) {
  const V s = hn::Mul(x, x);
  V p = constant(1.0 / 355687428096000.0);
  p = hn::Sub(hn::Mul(p, s), constant(1.0 / 1307674368000.0));
  p = hn::Add(hn::Mul(p, s), constant(1.0 / 6227020800.0));
  p = hn::Sub(hn::Mul(p, s), constant(1.0 / 39916800.0));
  p = hn::Add(hn::Mul(p, s), constant(1.0 / 362880.0));
  p = hn::Sub(hn::Mul(p, s), constant(1.0 / 5040.0));
  p = hn::Add(hn::Mul(p, s), constant(1.0 / 120.0));
  p = hn::Sub(hn::Mul(p, s), constant(1.0 / 6.0));
  return hn::Add(x, hn::Mul(hn::Mul(x, s), p));
}

HWY_INLINE V cos_near_zero(V x) {
  const V s = hn::Mul(x, x);
  V p = constant(-1.0 / 6402373705728000.0);
  p = hn::Add(hn::Mul(p, s), constant(1.0 / 20922789888000.0));
  p = hn::Sub(hn::Mul(p, s), constant(1.0 / 87178291200.0));
  p = hn::Add(hn::Mul(p, s), constant(1.0 / 479001600.0));
  p = hn::Sub(hn::Mul(p, s), constant(1.0 / 3628800.0));
  p = hn::Add(hn::Mul(p, s), constant(1.0 / 40320.0));
  p = hn::Sub(hn::Mul(p, s), constant(1.0 / 720.0));
  p = hn::Add(hn::Mul(p, s), constant(1.0 / 24.0));
  return hn::Add(hn::Sub(constant(1), hn::Mul(constant(0.5), s)), hn::Mul(hn::Mul(s, s), p));
}

HWY_INLINE SinCos sin_cos(V angle) {
  // Adding and subtracting 1.5 * 2^52 rounds to the nearest integer, ties to even.
  const V magic = constant(0x1.8p52);
  const V k = hn::Sub(hn::Add(hn::Mul(angle, constant(2.0 / elementary::kPi)), magic), magic);
  const V first = hn::Sub(angle, hn::Mul(k, constant(0x1.921fb544p+0)));
  const V second = hn::Sub(first, hn::Mul(k, constant(0x1.0b4611a6p-34)));
  const V r = hn::Sub(second, hn::Mul(k, constant(0x1.3198a2e037073p-69)));
  const V near_sin = sin_near_zero(r), near_cos = cos_near_zero(r);
  const Mask is_one = hn::Eq(k, constant(1)), is_two = hn::Eq(k, constant(2));
  const V s = hn::IfThenElse(is_one, near_cos, near_sin), c = hn::IfThenElse(is_one, near_sin, near_cos);
  return {hn::IfThenElse(is_two, hn::Neg(s), s), hn::IfThenElse(hn::Or(is_one, is_two), hn::Neg(c), c)};
}

// The same for surface.
HWY_INLINE Three surface_local(V dx, V dy, double texel_angle) {
  const V r = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
  const SinCos beta = sin_cos(hn::Mul(r, constant(texel_angle)));
  const V s = hn::Div(beta.sin, r);
  const Mask off_axis = hn::Gt(r, hn::Zero(D()));
  return {hn::IfThenElseZero(off_axis, hn::Mul(s, dx)), hn::IfThenElseZero(off_axis, hn::Mul(s, dy)), beta.cos};
}

HWY_INLINE V in_world(const RayFrame& f, int i, const Three& d) {
  return hn::Add(hn::Add(hn::Mul(constant(f.axis_x[i]), d.x), hn::Mul(constant(f.axis_y[i]), d.y)),
                 hn::Mul(constant(f.axis_z[i]), d.z));
}

}  // namespace

void ray_directions(const RayFrame& frame, const double* x, const double* y, std::size_t count, float* direction_x,
                    float* direction_y, float* direction_z) {
  const D d;
  const Floats floats;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V dx = hn::LoadU(d, x + i), dy = hn::LoadU(d, y + i);
    const Three local =
        frame.is_surface ? surface_local(dx, dy, frame.texel_angle) : plane_local(dx, dy, frame.texel_angle);
    hn::StoreU(hn::DemoteTo(floats, in_world(frame, 0, local)), floats, direction_x + i);
    hn::StoreU(hn::DemoteTo(floats, in_world(frame, 1, local)), floats, direction_y + i);
    hn::StoreU(hn::DemoteTo(floats, in_world(frame, 2, local)), floats, direction_z + i);
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void ray_directions(const RayFrame& frame, const double* x, const double* y, std::size_t count, float* direction_x,
                    float* direction_y, float* direction_z) {
  FACEMAP_DISPATCH(ray_directions)(frame, x, y, count, direction_x, direction_y, direction_z);
}

}  // namespace facemap::simd
#endif
