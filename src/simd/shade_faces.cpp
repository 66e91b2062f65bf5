#include "simd/shade_faces.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shade_faces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/seen_three.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

HWY_INLINE void orient_lanes(const PlaneBatch& planes, ShadedFaces& faces, std::size_t i) {
  Mask has_length;
  const V turn = hn::IfThenElse(hn::Lt(load(faces.side + i), hn::Zero(D())), constant(1), constant(-1));
  store(times(normalized(load(planes.normal, i), &has_length), turn), faces.towards, i);
}

// The operations of Shader::surface_at on a face's corners, in their order.
HWY_INLINE void smooth_lanes(ShadedFaces& faces, std::size_t i) {
  const V zero = hn::Zero(D());
  Three normals[3], sum = all(0);
  V largest = zero;
  Mask all_given = hn::Eq(zero, zero);
  for (int k = 0; k < 3; ++k) {
    Mask given;
    normals[k] = normalized(promoted(faces.file_normals + 3 * k, i), &given);
    all_given = hn::And(all_given, given);
    sum = plus(sum, normals[k]);
    const Three size = magnitude(load(faces.corners + 3 * k, i));
    largest = hn::Max(largest, hn::Max(size.x, hn::Max(size.y, size.z)));
  }
  const V turn = hn::IfThenElse(hn::Lt(dot(sum, load(faces.towards, i)), zero), constant(-1), constant(1));
  for (int k = 0; k < 3; ++k) store(times(normals[k], turn), faces.normals + 3 * k, i);
  store(hn::IfThenElseZero(all_given, constant(1)), faces.is_smooth + i);
  store(largest, faces.largest + i);
}

}  // namespace

void place_corners(const PlaneBatch& planes, ShadedFaces& faces) {
  for (std::size_t i = 0; i < planes.count; i += hn::Lanes(D())) {
    for (int k = 0; k < 9; ++k) store(promoted(planes.corners[k] + i), faces.corners[k] + i);
    const V offset = load(planes.offset + i);
    const Mask sure = hn::Gt(hn::Abs(offset), load(planes.offset_error + i));
    store(hn::IfThenElseZero(sure, hn::CopySign(constant(1), offset)), faces.side + i);
  }
}

void orient_faces(const PlaneBatch& planes, bool smooth, ShadedFaces& faces) {
  for (std::size_t i = 0; i < planes.count; i += hn::Lanes(D())) {
    orient_lanes(planes, faces, i);
    if (smooth) smooth_lanes(faces, i);
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void place_corners(const PlaneBatch& planes, ShadedFaces& faces) { FACEMAP_DISPATCH(place_corners)(planes, faces); }

void orient_faces(const PlaneBatch& planes, bool smooth, ShadedFaces& faces) {
  FACEMAP_DISPATCH(orient_faces)(planes, smooth, faces);
}

}  // namespace facemap::simd
#endif
