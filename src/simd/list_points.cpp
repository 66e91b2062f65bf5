#include "simd/list_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/list_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using FloatTag = hn::Rebind<float, Tag>;
using IntTag = hn::Rebind<std::int32_t, Tag>;
using V = hn::Vec<Tag>;

// In the order of operations of dot() in math/dvector.h.
HWY_INLINE V dot(V x, V y, V z, const double a[3]) {
  const Tag tag;
  const V xa = hn::Mul(x, hn::Set(tag, a[0])), ya = hn::Mul(y, hn::Set(tag, a[1])), za = hn::Mul(z, hn::Set(tag, a[2]));
  return hn::Add(hn::Add(xa, ya), za);
}

HWY_INLINE V difference(const float* p, double origin) {
  const Tag tag;
  return hn::Sub(hn::PromoteTo(tag, hn::Load(FloatTag(), p)), hn::Set(tag, origin));
}

HWY_INLINE void store_rounded(V v, V scale, float* to) {
  hn::Store(hn::DemoteTo(FloatTag(), hn::Mul(v, scale)), FloatTag(), to);
}

void find_offsets(const double origin[3], double map_units, PointChunk& chunk) {
  const Tag tag;
  const V scale = hn::Set(tag, map_units);
  for (std::size_t i = 0; i < kChunk; i += hn::Lanes(tag)) {
    const V x = difference(chunk.x + i, origin[0]);
    const V y = difference(chunk.y + i, origin[1]);
    const V z = difference(chunk.z + i, origin[2]);
    hn::Store(x, tag, chunk.offset_x + i);
    hn::Store(y, tag, chunk.offset_y + i);
    hn::Store(z, tag, chunk.offset_z + i);
    const V square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    hn::Store(hn::Mul(hn::Sqrt(square), scale), tag, chunk.length + i);
    store_rounded(x, scale, chunk.D_x + i);
    store_rounded(y, scale, chunk.D_y + i);
    store_rounded(z, scale, chunk.D_z + i);
  }
}

// Projection::map_from_local for a plane, and the raster's borders. The comparisons fail for NaN.
void find_texels(const PlaneMap& map, PointChunk& chunk) {
  const Tag tag;
  const V zero = hn::Zero(tag), one = hn::Set(tag, 1.0), texel_angle = hn::Set(tag, map.texel_angle);
  const V width = hn::Set(tag, map.width), height = hn::Set(tag, map.height);
  const V centre_x = hn::Set(tag, map.width * 0.5), centre_y = hn::Set(tag, map.height * 0.5);
  for (std::size_t i = 0; i < kChunk; i += hn::Lanes(tag)) {
    const V x = hn::Load(tag, chunk.offset_x + i);
    const V y = hn::Load(tag, chunk.offset_y + i);
    const V z = hn::Load(tag, chunk.offset_z + i);
    const V depth = dot(x, y, z, map.axis_z);
    const V scale = hn::Div(one, hn::Mul(depth, texel_angle));
    const V map_x = hn::Add(centre_x, hn::Mul(dot(x, y, z, map.axis_x), scale));
    const V map_y = hn::Sub(centre_y, hn::Mul(dot(x, y, z, map.axis_y), scale));
    const hn::Mask<Tag> inside_x = hn::And(hn::Ge(map_x, zero), hn::Lt(map_x, width));
    const hn::Mask<Tag> inside_y = hn::And(hn::Ge(map_y, zero), hn::Lt(map_y, height));
    const hn::Mask<Tag> inside = hn::And(hn::Gt(depth, zero), hn::And(inside_x, inside_y));
    const V texel = hn::Add(hn::Mul(hn::Floor(map_y), width), hn::Floor(map_x));
    const V or_none = hn::IfThenElse(inside, texel, hn::Set(tag, -1.0));
    hn::Store(hn::DemoteTo(IntTag(), or_none), IntTag(), chunk.texel + i);
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void find_offsets(const double origin[3], double scale, PointChunk& chunk) {
  FACEMAP_DISPATCH(find_offsets)(origin, scale, chunk);
}

void find_texels(const PlaneMap& map, PointChunk& chunk) { FACEMAP_DISPATCH(find_texels)(map, chunk); }

}  // namespace facemap::simd
#endif
