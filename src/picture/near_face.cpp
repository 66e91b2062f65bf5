#include "picture/near_face.h"

#include <cmath>

namespace facemap {
namespace {

double size_of(const DVector& a) { return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z); }

// Roundings of doubles are bounded as in simd/shadow_planes.cpp: 2^-46 of products of lengths holds for each plane, and
// for its dot product with D.
constexpr double kRounding = 0x1p-45;

}  // namespace

NearFace near_face(std::uint32_t face, int side, const Triangle& corners, const Vector& light) {
  const DVector A = DVector(corners[0]) - DVector(light), B = DVector(corners[1]) - DVector(corners[0]),
                C = DVector(corners[2]) - DVector(corners[0]);
  const DVector normal = cross(B, C), ab = cross(A, B), ca = cross(C, A);
  const double s = side, normal_error = kRounding * size_of(B) * size_of(C);
  const double error = kRounding * size_of(A) * (size_of(B) + size_of(C)) + normal_error;
  return {face,
          side,
          {{s * ab, error}, {s * ((normal - ab) - ca), error}, {s * ca, error}},
          {s * normal, normal_error},
          s * dot(A, normal),
          normal_error * size_of(A)};
}

int verdict_on(const NearFace& face, const DVector& D, double error) {
  const double size = size_of(D);
  bool is_sure = true;
  const auto is_no = [&](const NearFace::Plane& plane, double offset, double offset_error) {
    const double value = dot(plane.normal, D) - offset;
    const double bound = plane.error * size + size_of(plane.normal) * (error + kRounding * size) + offset_error +
                         kRounding * std::fabs(offset);
    is_sure = is_sure && value > bound;
    return value < -bound;
  };
  if (is_no(face.plane, face.offset, face.offset_error)) return -1;
  for (const NearFace::Plane& edge : face.edges) {
    if (is_no(edge, 0, 0)) return -1;
  }
  return is_sure ? 1 : 0;
}

}  // namespace facemap
