#include "simd/seen_planes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/seen_planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/seen_three.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

// Slope n . d: 4 + 3 = 7 u of the spreads' sum, |d_i| being at most 1 + 2^-22. The point's distance |delta / w|
// (letters of ray_parameter) is off by at most (8 u rho + 7 u |t|) sum / |w|, |t| <= rho (1 + 2^-21), rho the farthest
// corner's distance: less than 16 u rho sum / |w|.
constexpr double kSlopeError = 0x1p-49;

// One component of a cross product, p q - r s, and the sum of its magnitudes.
HWY_INLINE V minor_of(V p, V q, V r, V s, V* spread) {
  const V pq = hn::Mul(p, q), rs = hn::Mul(r, s);
  *spread = hn::Add(hn::Abs(pq), hn::Abs(rs));
  return hn::Sub(pq, rs);
}

HWY_INLINE void set_up_lanes(PlaneBatch& planes, const Three& K, std::size_t i) {
  const Three a = promoted(planes.corners, i), b = promoted(planes.corners + 3, i), c = promoted(planes.corners + 6, i);
  const Three e = minus(b, a), f = minus(c, a), from_K = minus(a, K);
  Three n, spread;
  n.x = minor_of(e.y, f.z, e.z, f.y, &spread.x);
  n.y = minor_of(e.z, f.x, e.x, f.z, &spread.y);
  n.z = minor_of(e.x, f.y, e.y, f.x, &spread.z);
  store(n, planes.normal, i);
  store(spread, planes.spread, i);
  store(dot(n, from_K), planes.offset + i);
  store(hn::Mul(constant(kOffsetError), dot(spread, magnitude(from_K))), planes.offset_error + i);
  const Three b_from_K = minus(b, K), c_from_K = minus(c, K);
  const V rho = hn::Sqrt(hn::Max(dot(from_K, from_K), hn::Max(dot(b_from_K, b_from_K), dot(c_from_K, c_from_K))));
  const V sum = hn::Add(hn::Add(spread.x, spread.y), spread.z);
  store(hn::Mul(hn::Mul(constant(kSlopeError), sum), rho), planes.slope_error + i);
}

}  // namespace

void load_corners(const std::uint32_t* triangles, const float* positions, const std::uint32_t* faces,
                  PlaneBatch& planes) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto* indices = reinterpret_cast<const std::int32_t*>(triangles);
  for (std::size_t i = 0; i < planes.count; i += hn::Lanes(d)) {
    const auto used = hn::FirstN(di, planes.count - i);
    const auto id = hn::IfThenElseZero(used, hn::LoadU(di, reinterpret_cast<const std::int32_t*>(faces) + i));
    const auto triangle = hn::Add(id, hn::Add(id, id));
    for (int corner = 0; corner < 3; ++corner) {
      const auto vertex = hn::GatherIndex(di, indices + corner, triangle);
      const auto position = hn::Add(vertex, hn::Add(vertex, vertex));
      for (int axis = 0; axis < 3; ++axis) {
        hn::StoreU(hn::GatherIndex(d, positions + axis, position), d, planes.corners[3 * corner + axis] + i);
      }
    }
  }
}

void set_up_planes(PlaneBatch& planes, const float K[3]) {
  for (std::size_t i = 0; i < planes.count; i += hn::Lanes(D())) set_up_lanes(planes, point(K), i);
}

// Parallel light along d is on the side where n . d has the sign that n . (a - L) has for a light at L.
void find_facing(const PlaneBatch& planes, const float (*lights)[3], int light_count, unsigned parallel,
                 std::int32_t* facing, std::int32_t* unsure) {
  const V zero = hn::Zero(D());
  for (std::size_t i = 0; i < planes.count; i += hn::Lanes(D())) {
    const Three a = promoted(planes.corners, i), n = load(planes.normal, i), spread = load(planes.spread, i);
    const V camera = load(planes.offset + i);
    const Mask camera_sure = hn::Gt(hn::Abs(camera), load(planes.offset_error + i));
    const V camera_sign = hn::CopySign(constant(1), camera);
    V facing_bits = zero, unsure_bits = zero;
    for (int l = 0; l < light_count; ++l) {
      const bool is_parallel = (parallel >> l & 1) != 0;
      const Three from_light = is_parallel ? point(lights[l]) : minus(a, point(lights[l]));
      const V same = hn::Mul(camera_sign, dot(n, from_light));
      const V error = hn::Mul(constant(kOffsetError), dot(spread, magnitude(from_light)));
      // Where the bound is 0, all terms are, and so is the true value.
      const Mask sure = hn::And(camera_sure, hn::Or(hn::Gt(hn::Abs(same), error), hn::Eq(error, zero)));
      const V bit = constant(1 << l);
      facing_bits = hn::Add(facing_bits, hn::IfThenElseZero(hn::And(sure, hn::Gt(same, zero)), bit));
      unsure_bits = hn::Add(unsure_bits, hn::IfThenZeroElse(sure, bit));
    }
    store_integers(facing_bits, facing + i);
    store_integers(unsure_bits, unsure + i);
  }
}

bool meet_planes(const PlaneBatch& planes, const double base[3], double allowed, RayBatch& rays,
                 std::uint8_t* is_sharp) {
  const D d;
  bool some_dull = false;
  for (std::size_t i = 0; i < rays.count; i += hn::Lanes(d)) {
    const auto slot = hn::LoadU(Places(), rays.slots + i);
    const Three n = gather(planes.normal, slot), direction = promoted(rays.direction, i);
    const V slope = dot(n, direction);
    const V t = hn::Div(hn::GatherIndex(d, planes.offset, slot), slope);
    store(plus(point(base), times(direction, t)), rays.offset, i);
    const Mask sharp = hn::Ge(hn::Mul(hn::Abs(slope), constant(allowed)), hn::GatherIndex(d, planes.slope_error, slot));
    if (hn::AllTrue(d, sharp)) continue;
    if (!some_dull) {
      for (std::size_t k = 0; k < kSeenBatch; ++k) is_sharp[k] = 1;
      some_dull = true;
    }
    HWY_ALIGN std::int32_t flags[hn::MaxLanes(D())];
    store_integers(hn::IfThenElseZero(sharp, constant(1)), flags);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) is_sharp[i + k] = static_cast<std::uint8_t>(flags[k]);
  }
  return some_dull;
}

bool round_offsets(const RayBatch& rays, double inverse_step, std::int32_t* x, std::int32_t* y, std::int32_t* z) {
  const D d;
  const V limit = constant(0x1p30), factor = constant(inverse_step), magic = constant(0x1.8p52);
  std::int32_t* out[3] = {x, y, z};
  bool fits = true;
  for (std::size_t i = 0; i < rays.count; i += hn::Lanes(d)) {
    const Mask used = hn::FirstN(d, rays.count - i);
    for (int axis = 0; axis < 3; ++axis) {
      const V steps = hn::Mul(load(rays.offset[axis] + i), factor);
      // Adding and subtracting 1.5 * 2^52 rounds to the nearest integer, ties to even.
      const V rounded = hn::Sub(hn::Add(steps, magic), magic);
      const Mask inside = hn::Lt(hn::Abs(rounded), limit);
      fits = fits && hn::AllTrue(d, hn::Or(inside, hn::Not(used)));
      store_integers(hn::IfThenElseZero(inside, rounded), out[axis] + i);
    }
  }
  return fits;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void load_corners(const std::uint32_t* triangles, const float* positions, const std::uint32_t* faces,
                  PlaneBatch& planes) {
  FACEMAP_DISPATCH(load_corners)(triangles, positions, faces, planes);
}

void set_up_planes(PlaneBatch& planes, const float K[3]) { FACEMAP_DISPATCH(set_up_planes)(planes, K); }

void find_facing(const PlaneBatch& planes, const float (*lights)[3], int light_count, unsigned parallel,
                 std::int32_t* facing, std::int32_t* unsure) {
  FACEMAP_DISPATCH(find_facing)(planes, lights, light_count, parallel, facing, unsure);
}

bool meet_planes(const PlaneBatch& planes, const double base[3], double allowed, RayBatch& rays,
                 std::uint8_t* is_sharp) {
  return FACEMAP_DISPATCH(meet_planes)(planes, base, allowed, rays, is_sharp);
}

bool round_offsets(const RayBatch& rays, double inverse_step, std::int32_t* x, std::int32_t* y, std::int32_t* z) {
  return FACEMAP_DISPATCH(round_offsets)(rays, inverse_step, x, y, z);
}

}  // namespace facemap::simd
#endif
