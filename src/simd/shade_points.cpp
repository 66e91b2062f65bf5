#include "simd/shade_points.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shade_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/seen_three.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

// Lifted points beyond this (world units) may overflow float32.
constexpr double kLargestFloat = 0x1p127;

// std::max(0.0, x) and std::min(0.0, x), NaN included.
HWY_INLINE V not_below_zero(V x) { return hn::IfThenElseZero(hn::Gt(x, hn::Zero(D())), x); }
HWY_INLINE V not_above_zero(V x) { return hn::IfThenElseZero(hn::Lt(x, hn::Zero(D())), x); }

HWY_INLINE Mask is_finite(V x) { return hn::Lt(hn::Abs(x), constant(HUGE_VAL)); }

struct Corners {
  Three a, b, c;
};

HWY_INLINE Corners corners_at(const double (*rows)[kSeenBatch], hn::Vec<Places> slots) {
  return {gather(rows, slots), gather(rows + 3, slots), gather(rows + 6, slots)};
}

HWY_INLINE Three barycentric(const Corners& v, const Three& n, const Three& p) {
  const V x = not_below_zero(dot(n, cross(minus(v.c, v.b), minus(p, v.b))));
  const V y = not_below_zero(dot(n, cross(minus(v.a, v.c), minus(p, v.c))));
  const V z = not_below_zero(dot(n, cross(minus(v.b, v.a), minus(p, v.a))));
  const V sum = hn::Add(hn::Add(x, y), z);
  const Mask some = hn::Gt(sum, hn::Zero(D()));
  return chosen(some, times({x, y, z}, hn::Div(constant(1), sum)), all(1.0 / 3));
}

HWY_INLINE Three weighted(const Corners& v, const Three& w) {
  return plus(plus(times(v.a, w.x), times(v.b, w.y)), times(v.c, w.z));
}

HWY_INLINE Three sum_of_normals(const Corners& normals, const Three& w) {
  return plus(plus(plus(all(0), times(normals.a, w.x)), times(normals.b, w.y)), times(normals.c, w.z));
}

HWY_INLINE Three smooth_normal(const ShadedFaces& faces, hn::Vec<Places> slots, const Three& w, const Three& flat) {
  const Corners normals = corners_at(faces.normals, slots);
  Mask has_length;
  const Three unit = normalized(sum_of_normals(normals, w), &has_length);
  const Mask given = hn::Gt(hn::GatherIndex(D(), faces.is_smooth, slots), hn::Zero(D()));
  return chosen(hn::And(has_length, given), unit, flat);
}

}  // namespace

void find_surfaces(const PlaneBatch& planes, const ShadedFaces& faces, const RayBatch& rays, const float K[3],
                   bool smooth, ShadedPoints& points) {
  for (std::size_t i = 0; i < rays.count; i += hn::Lanes(D())) {
    const auto slots = hn::LoadU(Places(), rays.slots + i);
    const Corners v = corners_at(faces.corners, slots);
    const Three n = gather(planes.normal, slots), d = promoted(rays.direction, i);
    // A ray so grazing that its slope rounds to zero gets the corner.
    const V t = hn::Div(hn::GatherIndex(D(), planes.offset, slots), dot(n, d));
    const Three p = chosen(is_finite(t), plus(point(K), times(d, t)), v.a);
    const Three w = barycentric(v, n, p);
    store(w, points.weights, i);
    store(weighted(v, w), points.position, i);
    const Three flat = gather(faces.towards, slots);
    store(smooth ? smooth_normal(faces, slots, w, flat) : flat, points.normal, i);
  }
}

namespace {

// Hanika 2021: lift the point to the plane of the corner's normal if it lies below.
HWY_INLINE Three lifted(const Three& shift, const Three& position, const Three& corner, const Three& normal, V weight) {
  const V below = not_above_zero(dot(minus(position, corner), normal));
  return minus(shift, times(normal, hn::Mul(below, weight)));
}

HWY_INLINE Mask is_below(const Three& a, double limit) {
  const Three size = magnitude(a);
  return hn::And(hn::Lt(size.x, constant(limit)),
                 hn::And(hn::Lt(size.y, constant(limit)), hn::Lt(size.z, constant(limit))));
}

HWY_INLINE V rounded_to_float(V x) { return hn::PromoteTo(D(), hn::DemoteTo(Floats(), x)); }

struct SideTest {
  Mask same, sure;
};

// Whether P, rounded to float32, is on the camera's side of its face.
HWY_INLINE SideTest test_side(const PlaneBatch& planes, const ShadedFaces& faces, hn::Vec<Places> slots, const Three& a,
                              const Three& P) {
  const Three rounded = {rounded_to_float(P.x), rounded_to_float(P.y), rounded_to_float(P.z)};
  const Three from_P = minus(a, rounded);
  const V value = hn::Mul(dot(gather(planes.normal, slots), from_P), hn::GatherIndex(D(), faces.side, slots));
  const V error = hn::Mul(constant(kOffsetError), dot(gather(planes.spread, slots), magnitude(from_P)));
  const Mask sure = hn::And(is_below(P, kLargestFloat), hn::Gt(hn::Abs(value), error));
  return {hn::Gt(value, hn::Zero(D())), sure};
}

}  // namespace

bool find_lifts(const PlaneBatch& planes, const ShadedFaces& faces, const RayBatch& rays, double least_lift,
                ShadedPoints& points) {
  const V zero = hn::Zero(D());
  bool any = false;
  for (std::size_t i = 0; i < rays.count; i += hn::Lanes(D())) {
    const auto slots = hn::LoadU(Places(), rays.slots + i);
    const Corners v = corners_at(faces.corners, slots), normals = corners_at(faces.normals, slots);
    const Three w = load(points.weights, i), position = load(points.position, i);
    Three shift = all(0);
    shift = lifted(shift, position, v.a, normals.a, w.x);
    shift = lifted(shift, position, v.b, normals.b, w.y);
    shift = lifted(shift, position, v.c, normals.c, w.z);
    const V length = hn::Sqrt(dot(shift, shift));
    const V least = hn::Mul(constant(least_lift), hn::GatherIndex(D(), faces.largest, slots));
    // Without a smooth normal there is no lift.
    const Mask has_length = hn::Gt(largest_of(sum_of_normals(normals, w)), zero);
    const Mask given = hn::Gt(hn::GatherIndex(D(), faces.is_smooth, slots), zero);
    const Mask far = hn::And(hn::And(has_length, given), hn::Gt(length, least));
    const Three moved = plus(position, shift);
    const SideTest side = test_side(planes, faces, slots, v.a, moved);
    const V verdict =
        hn::IfThenElse(side.sure, hn::IfThenElseZero(side.same, constant(kLifted)), constant(kUnsureLift));
    store(moved, points.moved, i);
    store_integers(hn::IfThenElseZero(far, verdict), points.lift + i);
    any = any || !hn::AllFalse(D(), far);
  }
  return any;
}

void find_smooth_normals(const ShadedFaces& faces, const RayBatch& rays, ShadedPoints& points) {
  for (std::size_t i = 0; i < rays.count; i += hn::Lanes(D())) {
    const auto slots = hn::LoadU(Places(), rays.slots + i);
    const Three flat = gather(faces.towards, slots);
    store(smooth_normal(faces, slots, load(points.weights, i), flat), points.normal, i);
  }
}

namespace {

HWY_INLINE V between_0_and_1(V x) { return hn::Min(not_below_zero(x), constant(1)); }

// What cone and range leave (render/light_sources.cpp).
HWY_INLINE V window(const LightSource& light, const Three& to_light, V squared, V distance) {
  V share = constant(1);
  if (light.is_spot) {
    const V cosine = hn::Div(hn::Neg(dot(point(light.axis), to_light)), distance);
    const V edge = between_0_and_1(hn::Add(hn::Mul(cosine, constant(light.cone_scale)), constant(light.cone_offset)));
    share = hn::Mul(edge, edge);
  }
  if (light.has_range) {
    const V ratio = hn::Div(squared, constant(light.squared_range));
    share = hn::Mul(share, between_0_and_1(hn::Sub(constant(1), hn::Mul(ratio, ratio))));
  }
  return share;
}

HWY_INLINE Three way_to(const LightSource& light, const Three& position) {
  return light.is_parallel ? point(light.towards) : minus(point(light.position), position);
}

}  // namespace

// Where the numerator of add_lights' cosine, in the same order, is not above 0 neither is the cosine.
void find_lights_before(const LightSource* lights, int light_count, std::size_t count, const ShadedPoints& points,
                        std::int64_t* bits) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(D())) {
    const Three position = load(points.position, i), normal = load(points.normal, i);
    auto found = hn::Zero(Places());
    for (int l = 0; l < light_count; ++l) {
      const Three to_light = way_to(lights[l], position);
      const auto before = hn::RebindMask(Places(), hn::Gt(dot(normal, to_light), hn::Zero(D())));
      found = hn::Or(found, hn::IfThenElseZero(before, hn::Set(Places(), std::int64_t{1} << l)));
    }
    hn::StoreU(found, Places(), bits + i);
  }
}

void find_lights_reaching(const LightSource* lights, int light_count, std::size_t count, const ShadedPoints& points,
                          std::int64_t* bits) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(D())) {
    const Three position = load(points.position, i);
    auto found = hn::Zero(Places());
    for (int l = 0; l < light_count; ++l) {
      const auto bit = hn::Set(Places(), std::int64_t{1} << l);
      if (!lights[l].is_spot && !lights[l].has_range) {
        found = hn::Or(found, bit);
        continue;
      }
      const Three to_light = way_to(lights[l], position);
      const V squared = dot(to_light, to_light);
      const V share = window(lights[l], to_light, squared, hn::Sqrt(squared));
      const auto is_within = hn::RebindMask(Places(), hn::Gt(share, hn::Zero(D())));
      found = hn::Or(found, hn::IfThenElseZero(is_within, bit));
    }
    hn::StoreU(found, Places(), bits + i);
  }
}

void add_lights(const LightSource* lights, int light_count, const std::int64_t* lit, std::size_t count,
                ShadedPoints& points) {
  const V zero = hn::Zero(D());
  for (std::size_t i = 0; i < count; i += hn::Lanes(D())) {
    const auto bits = hn::LoadU(Places(), lit + i);
    const Three position = load(points.position, i), normal = load(points.normal, i);
    Three radiance = load(points.radiance, i);
    for (int l = 0; l < light_count; ++l) {
      const Mask is_lit = hn::RebindMask(D(), hn::TestBit(bits, hn::Set(Places(), std::int64_t{1} << l)));
      if (hn::AllFalse(D(), is_lit)) continue;
      const LightSource& light = lights[l];
      const Three to_light = way_to(light, position);
      const V squared = light.is_parallel ? constant(1) : dot(to_light, to_light);
      const V distance = hn::Sqrt(squared);
      const V cosine = hn::Div(dot(normal, to_light), distance);
      V share = light.inverse_square ? hn::Div(constant(1), squared) : constant(1);
      if (light.is_spot || light.has_range) share = hn::Mul(share, window(light, to_light, squared, distance));
      const V strength = hn::Mul(hn::Mul(constant(light.intensity), cosine), share);
      const Mask shines = hn::And(is_lit, hn::And(hn::Gt(squared, zero), hn::Gt(cosine, zero)));
      const Three sum = plus(radiance, times(point(light.color), strength));
      radiance = chosen(shines, sum, radiance);
    }
    store(radiance, points.radiance, i);
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void find_surfaces(const PlaneBatch& planes, const ShadedFaces& faces, const RayBatch& rays, const float K[3],
                   bool smooth, ShadedPoints& points) {
  FACEMAP_DISPATCH(find_surfaces)(planes, faces, rays, K, smooth, points);
}

bool find_lifts(const PlaneBatch& planes, const ShadedFaces& faces, const RayBatch& rays, double least_lift,
                ShadedPoints& points) {
  return FACEMAP_DISPATCH(find_lifts)(planes, faces, rays, least_lift, points);
}

void find_smooth_normals(const ShadedFaces& faces, const RayBatch& rays, ShadedPoints& points) {
  FACEMAP_DISPATCH(find_smooth_normals)(faces, rays, points);
}

void find_lights_before(const LightSource* lights, int light_count, std::size_t count, const ShadedPoints& points,
                        std::int64_t* bits) {
  FACEMAP_DISPATCH(find_lights_before)(lights, light_count, count, points, bits);
}

void find_lights_reaching(const LightSource* lights, int light_count, std::size_t count, const ShadedPoints& points,
                          std::int64_t* bits) {
  FACEMAP_DISPATCH(find_lights_reaching)(lights, light_count, count, points, bits);
}

void add_lights(const LightSource* lights, int light_count, const std::int64_t* lit, std::size_t count,
                ShadedPoints& points) {
  FACEMAP_DISPATCH(add_lights)(lights, light_count, lit, count, points);
}

}  // namespace facemap::simd
#endif
