#include "simd/nearest_planes.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/nearest_planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/vectors-inl.h"

// Let P = (X, Y, Z) be a face's first corner, Q1 and Q2 its edges from there, all rotated; m0 = P x Q1 and m2 = Q2 x P
// the planes of two edges, n = Q1 x Q2 its own, m1 = n - m0 - m2 that of the third; D = n . P = s |D|. A ray (u, v, 1)
// is inside where s m . (u, v, 1) > 0 for all three, and meets the face's plane at 1/Z = w = n . (u, v, 1) / D.
//
// Roundings in double, h = 2^-53, r and q as in PlaneFrame: P is off by 4 h f r (its third component without f), each Q
// by 4 h f q, since their differences are taken from the vertices. So m0 and m2 are off by 24 h f r q, n by 24 h f q^2
// (third components f times that), m1 by 32 h f q (2 r + q), and the sums for a value at (u, v) add 8 h: value_error =
// 64 h f (U + V + f) covers an edge's value, and a w's after division. D has three terms of n and P, 39 h each:
// determinant_error = 128 h f^2.
//
// Roundings to float32, k = 2^-24: with a = |A| width, b = |B| height, c = |C|, a value is off by at most
// 4 k (a + b + c) (coefficients, products, sums). If c <= 2 (a + b) that is 12 k (a + b), which the bound holds; else
// the value is c/2 at least, and its sign is right whatever the bound. For w the last term is taken relative to w.
HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using Vector = Vector3<V>;
using Floats = hn::Rebind<float, D>;
using Integers = hn::Rebind<std::int32_t, D>;

constexpr double kEdgeRoundings = 15 * 0x1p-24;
constexpr double kDepthRoundings = 10 * 0x1p-24;
constexpr double kShiftSlack = 1 + 0x1p-10;  // for bounds that are rounded themselves
constexpr double kSharpness = 0x1p17;        // half of a sharp w's error may come from the bound
constexpr double kLeastSharp = 0x1p-100;     // above 0: a sharp w is
constexpr double kSharpDeterminant = 0x1p20;
constexpr double kLargestDepth = 0x1p60;  // coefficients of w; times |u| and |v| below 2^20
constexpr double kLargestFloat = 0x1p100;

HWY_INLINE V constant(double x) { return hn::Set(D(), x); }

HWY_INLINE Vector rotated(const PlaneFrame& f, const Vector& a) {
  const Vector rows[3] = {{constant(f.rows[0][0]), constant(f.rows[0][1]), constant(f.rows[0][2])},
                          {constant(f.rows[1][0]), constant(f.rows[1][1]), constant(f.rows[1][2])},
                          {constant(f.rows[2][0]), constant(f.rows[2][1]), constant(f.rows[2][2])}};
  return {dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)};
}

// Corners of 16 faces: corner[i][axis][face].
struct Corners {
  alignas(64) float of[3][3][kBlockFaces];
};

HWY_INLINE void gather(const FaceSource& source, const std::uint32_t* faces, std::size_t count, Corners& corners) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  alignas(64) std::int32_t ids[kBlockFaces];
  std::fill(ids, ids + kBlockFaces, static_cast<std::int32_t>(faces[0]));  // the rest of the block repeats the first
  std::copy(faces, faces + count, ids);
  for (std::size_t i = 0; i < kBlockFaces; i += hn::Lanes(d)) {
    const auto id = hn::Load(di, ids + i), triangle = hn::Add(id, hn::Add(id, id));
    for (int corner = 0; corner < 3; ++corner) {
      const auto* indices = reinterpret_cast<const std::int32_t*>(source.triangles) + corner;
      const auto vertex = hn::GatherIndex(di, indices, triangle);
      const auto position = hn::Add(vertex, hn::Add(vertex, vertex));
      for (int axis = 0; axis < 3; ++axis) {
        hn::Store(hn::GatherIndex(d, source.positions + axis, position), d, corners.of[corner][axis] + i);
      }
    }
  }
}

struct Planes {
  Vector edge[3];  // normalised by their bounds
  Vector w;
  V sharp;
  M is_unsure;
};

HWY_INLINE V bounded(V x) { return hn::Max(hn::Min(x, constant(kLargestFloat)), constant(-kLargestFloat)); }

// Boxes reach `width` and `height` samples from their first. `side`: 1 or -1 where it is known, or 0.
HWY_INLINE Planes planes_of(const PlaneFrame& f, const Corners& corners, std::size_t i, V width, V height, V side) {
  const D d;
  const Floats floats;
  Vector corner[3];
  for (int k = 0; k < 3; ++k) {
    corner[k] = {hn::PromoteTo(d, hn::Load(floats, corners.of[k][0] + i)),
                 hn::PromoteTo(d, hn::Load(floats, corners.of[k][1] + i)),
                 hn::PromoteTo(d, hn::Load(floats, corners.of[k][2] + i))};
  }
  const Vector origin = {constant(f.origin[0]), constant(f.origin[1]), constant(f.origin[2])};
  const Vector offset = corner[0] - origin, first = corner[1] - corner[0], second = corner[2] - corner[0];
  const V r = hn::Mul(sum_of_sizes(offset), constant(f.unit));
  const V q = hn::Mul(hn::Max(sum_of_sizes(first), sum_of_sizes(second)), constant(f.unit));

  const Vector P = rotated(f, offset), Q1 = rotated(f, first), Q2 = rotated(f, second);
  const Vector n = cross(Q1, Q2), m0 = cross(P, Q1), m2 = cross(Q2, P), m1 = (n - m0) - m2;
  const V determinant = dot(n, P), size = hn::Abs(determinant);
  const V qq = hn::Mul(q, q), error = hn::Mul(constant(f.determinant_error), hn::Mul(qq, r));
  const M is_sure = hn::Gt(size, error);
  const M is_known = hn::Gt(hn::Abs(side), constant(0.5));
  const V sign = hn::IfThenElse(is_known, side, hn::CopySign(constant(1), determinant));

  Planes planes;
  planes.is_unsure = hn::Not(hn::Or(is_sure, is_known));
  const V rest = hn::Mul(constant(f.value_error), hn::Mul(q, hn::Add(hn::Add(r, r), q)));
  const V shift = constant(f.shift * kShiftSlack);
  const Vector edges[3] = {m0, m1, m2};
  for (int k = 0; k < 3; ++k) {
    const V A = hn::Abs(edges[k].x), B = hn::Abs(edges[k].y);
    const V local = hn::Mul(constant(kEdgeRoundings), hn::Add(hn::Mul(A, width), hn::Mul(B, height)));
    const V bound = hn::Add(hn::Add(local, hn::Mul(shift, hn::Add(A, B))), rest);
    const V scale = hn::Div(sign, bound);
    planes.edge[k] = {hn::Mul(edges[k].x, scale), hn::Mul(edges[k].y, scale), hn::Mul(edges[k].z, scale)};
  }

  const V none = constant(-kLargestFloat);
  planes.edge[0] = {hn::IfThenZeroElse(planes.is_unsure, planes.edge[0].x),
                    hn::IfThenZeroElse(planes.is_unsure, planes.edge[0].y),
                    hn::IfThenElse(planes.is_unsure, none, planes.edge[0].z)};

  // Where D itself is not sharp, or w out of range, depths are not used.
  const V inverse = hn::Div(constant(1), determinant);
  const Vector w = {hn::Mul(n.x, inverse), hn::Mul(n.y, inverse), hn::Mul(n.z, inverse)};
  const M has_depth = hn::And(hn::And(hn::Gt(size, hn::Mul(error, constant(kSharpDeterminant))), hn::Not(is_known)),
                              hn::Lt(sum_of_sizes(w), constant(kLargestDepth)));
  planes.w = {hn::IfThenElseZero(has_depth, w.x), hn::IfThenElseZero(has_depth, w.y),
              hn::IfThenElseZero(has_depth, w.z)};
  const V A = hn::Abs(w.x), B = hn::Abs(w.y);
  const V local = hn::Mul(constant(kDepthRoundings), hn::Add(hn::Mul(A, width), hn::Mul(B, height)));
  const V lost = hn::Mul(hn::Mul(constant(f.value_error), qq), hn::Abs(inverse));
  const V bound = hn::Add(hn::Add(local, hn::Mul(shift, hn::Add(A, B))), lost);
  const V sharp = hn::Max(hn::Mul(bound, constant(kSharpness)), constant(kLeastSharp));
  planes.sharp =
      hn::IfThenElse(hn::And(has_depth, hn::Lt(sharp, constant(kLargestFloat))), sharp, constant(kNeverSharp));
  return planes;
}

HWY_INLINE V value_at(const Vector& plane, V u, V v) {
  return hn::Add(hn::Add(hn::Mul(plane.x, u), hn::Mul(plane.y, v)), plane.z);
}

HWY_INLINE void store_floats(V x, float* out) {
  const Floats floats;
  hn::Store(hn::DemoteTo(floats, bounded(x)), floats, out);
}

HWY_INLINE void store_flags(M flags, std::uint8_t* out) {
  const D d;
  alignas(64) double ones[kBlockFaces];
  hn::Store(hn::IfThenElseZero(flags, constant(1)), d, ones);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) out[i] = ones[i] != 0;
}

// (u, v): where the box's first sample lies.
HWY_INLINE void store(const Planes& planes, V u, V v, std::size_t i, FaceBlock& block) {
  for (int k = 0; k < 3; ++k) {
    store_floats(planes.edge[k].x, block.A[k] + i);
    store_floats(planes.edge[k].y, block.B[k] + i);
    store_floats(value_at(planes.edge[k], u, v), block.C[k] + i);
  }
  store_floats(planes.w.x, block.Aw + i);
  store_floats(planes.w.y, block.Bw + i);
  store_floats(value_at(planes.w, u, v), block.Cw + i);
  const Floats floats;
  hn::Store(hn::DemoteTo(floats, planes.sharp), floats, block.sharp + i);
  store_flags(planes.is_unsure, block.is_unsure + i);
  block.has_unsure = block.has_unsure || !hn::AllFalse(D(), planes.is_unsure);
}

}  // namespace

void set_up_faces(const FaceSource& source, const PlaneFrame& frame, double first_u, double first_v,
                  const FaceBoxes& boxes, FaceBlock& block) {
  const D d;
  Corners corners;
  gather(source, boxes.faces, boxes.count, corners);
  block.has_unsure = false;
  const Integers integers;
  for (std::size_t i = 0; i < kBlockFaces; i += hn::Lanes(d)) {
    const V x0 = hn::PromoteTo(d, hn::LoadU(integers, boxes.x0 + i)),
            x1 = hn::PromoteTo(d, hn::LoadU(integers, boxes.x1 + i));
    const V y0 = hn::PromoteTo(d, hn::LoadU(integers, boxes.y0 + i)),
            y1 = hn::PromoteTo(d, hn::LoadU(integers, boxes.y1 + i));
    const Planes planes = planes_of(frame, corners, i, hn::Sub(x1, x0), hn::Sub(y1, y0), hn::Zero(d));
    store(planes, hn::Add(constant(first_u), x0), hn::Add(constant(first_v), y0), i, block);
  }
}

void set_up_tile_faces(const FaceSource& source, const PlaneFrame& frame, double reach, const std::uint32_t* faces,
                       std::size_t count, const std::int8_t* sides, FaceBlock& block) {
  const D d;
  Corners corners;
  gather(source, faces, count, corners);
  alignas(64) double side[kBlockFaces] = {};
  for (std::size_t i = 0; i < count; ++i) side[i] = sides == nullptr ? 0 : sides[i];
  block.has_unsure = false;
  for (std::size_t i = 0; i < kBlockFaces; i += hn::Lanes(d)) {
    const Planes planes = planes_of(frame, corners, i, constant(reach), constant(reach), hn::Load(d, side + i));
    store(planes, hn::Zero(d), hn::Zero(d), i, block);
  }
}

void set_up_large(const FaceSource& source, const PlaneFrame& frame, const std::uint32_t* faces, std::size_t count,
                  const std::int8_t* sides, LargeFace* large) {
  const D d;
  Corners corners;
  gather(source, faces, count, corners);
  alignas(64) double side[kBlockFaces] = {};
  for (std::size_t i = 0; i < count; ++i) side[i] = sides == nullptr ? 0 : sides[i];
  alignas(64) double values[13][kBlockFaces];
  std::uint8_t is_unsure[kBlockFaces];
  for (std::size_t i = 0; i < kBlockFaces; i += hn::Lanes(d)) {
    const Planes planes =
        planes_of(frame, corners, i, constant(kLargeRun), constant(kBlockSide), hn::Load(d, side + i));
    for (int k = 0; k < 4; ++k) {
      const Vector& plane = k < 3 ? planes.edge[k] : planes.w;
      hn::Store(plane.x, d, values[3 * k] + i);
      hn::Store(plane.y, d, values[3 * k + 1] + i);
      hn::Store(plane.z, d, values[3 * k + 2] + i);
    }
    hn::Store(planes.sharp, d, values[12] + i);
    store_flags(planes.is_unsure, is_unsure + i);
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < 4; ++k) {
      large[i].A[k] = values[3 * k][i];
      large[i].B[k] = values[3 * k + 1][i];
      large[i].C[k] = values[3 * k + 2][i];
    }
    large[i].sharp = static_cast<float>(values[12][i]);
    large[i].is_unsure = is_unsure[i];
  }
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

void set_up_faces(const FaceSource& source, const PlaneFrame& frame, double first_u, double first_v,
                  const FaceBoxes& boxes, FaceBlock& block) {
  FACEMAP_DISPATCH(set_up_faces)(source, frame, first_u, first_v, boxes, block);
}

void set_up_tile_faces(const FaceSource& source, const PlaneFrame& frame, double reach, const std::uint32_t* faces,
                       std::size_t count, const std::int8_t* sides, FaceBlock& block) {
  FACEMAP_DISPATCH(set_up_tile_faces)(source, frame, reach, faces, count, sides, block);
}

void set_up_large(const FaceSource& source, const PlaneFrame& frame, const std::uint32_t* faces, std::size_t count,
                  const std::int8_t* sides, LargeFace* large) {
  FACEMAP_DISPATCH(set_up_large)(source, frame, faces, count, sides, large);
}

}  // namespace facemap::simd
#endif
