#include "visibility/own_face.h"

#include <cmath>

#include "math/dvector.h"
#include "picture/near_face.h"

namespace facemap {
namespace {

// Bounds say what is behind a patch of faces by more than twice this, relative (simd::kShadowDepthFactor): points that
// are hardly behind a face are not in the dark for a patch with it.
constexpr double kSurelyBehind = 0x1p-17;

// As in near_face.cpp, and as much again: of products of lengths, for a plane and its product with an offset.
constexpr double kRounding = 0x1p-44;

double size_of(const DVector& a) { return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z); }

// Whether the point at D from the origin, within `error` in each coordinate, is surely on the origin's side of a face's
// plane. So it is for most points: this is quick.
bool is_surely_before(const Triangle& face, const Vector& origin, const DVector& D, double error) {
  const DVector A = DVector(face[0]) - DVector(origin), B = DVector(face[1]) - DVector(face[0]),
                C = DVector(face[2]) - DVector(face[0]);
  const DVector normal = cross(B, C);
  const double offset = dot(normal, A), beyond = dot(normal, D) - offset;
  const double bound = kRounding * size_of(B) * size_of(C) * (size_of(A) + size_of(D)) + size_of(normal) * error;
  return std::fabs(offset) > bound && (offset > 0 ? beyond : -beyond) < -bound;
}

}  // namespace

bool may_be_dark_by_own(const PointQuestion& question, const AskedPoints& points, std::uint32_t point) {
  const std::uint32_t own = points.faces[point];
  if (own == kNoOwnFace || !question.faces.is_kept(own)) return false;
  const Triangle corners = triangle_of(question.faces, own);
  const DVector D = (1 - kSurelyBehind) * (place_of(points, point) - DVector(question.origin));
  const double error = error_of(points, point);
  if (is_surely_before(corners, question.origin, D, error)) return false;
  const int own_side = side(corners, question.origin);
  return own_side != 0 && verdict_on(near_face(own, own_side, corners, question.origin), D, error) >= 0;
}

}  // namespace facemap
