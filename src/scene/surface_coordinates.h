#pragma once

#include <facemap/mesh.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "math/dvector.h"

/// Where in its face a ray meets it: the one sequence of operations in double that everybody takes, so that whoever
/// asks twice gets the same texel. simd::find_surfaces has the same operations in the same order.
namespace facemap {

/// Texture coordinates in double.
using TexturePoint = glm::dvec2;

/// The corners of a face and its normal, cross(v1 - v0, v2 - v0), all in double.
struct FaceCorners {
  DVector v[3];
  DVector n;
};

inline FaceCorners corners_of(const Vector& v0, const Vector& v1, const Vector& v2) {
  FaceCorners c{{DVector(v0), DVector(v1), DVector(v2)}, {}};
  c.n = cross(c.v[1] - c.v[0], c.v[2] - c.v[0]);
  return c;
}

inline FaceCorners corners_of(const Mesh& mesh, std::size_t face) {
  return corners_of(mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2));
}

/// Where the line from K along d meets the plane; a ray so grazing that its slope rounds to zero gets the corner.
inline DVector point_on_plane(const FaceCorners& face, const DVector& K, const DVector& d) {
  const double t = dot(face.n, face.v[0] - K) / dot(face.n, d);
  return std::isfinite(t) ? K + d * t : face.v[0];
}

/// Weights of the corners at a point of the plane, not below 0 and of sum 1.
inline DVector barycentric(const FaceCorners& face, const DVector& p) {
  const auto& v = face.v;
  DVector weights(std::max(0.0, dot(face.n, cross(v[2] - v[1], p - v[1]))),
                  std::max(0.0, dot(face.n, cross(v[0] - v[2], p - v[2]))),
                  std::max(0.0, dot(face.n, cross(v[1] - v[0], p - v[0]))));
  const double sum = weights.x + weights.y + weights.z;
  return sum > 0 ? weights * (1 / sum) : DVector(1.0 / 3);
}

/// Texture coordinates at the corners of a face; zero where it has none.
struct CornerCoordinates {
  TexturePoint uv[3] = {TexturePoint(0), TexturePoint(0), TexturePoint(0)};
};

inline bool has_texture_coordinates(const Mesh& mesh, std::size_t face) {
  if (mesh.texture_corners.empty()) return false;
  const Corners& corners = mesh.texture_corners[face];
  return corners[0] != kNoIndex || corners[1] != kNoIndex || corners[2] != kNoIndex;
}

inline CornerCoordinates texture_corners_of(const Mesh& mesh, std::size_t face) {
  CornerCoordinates result;
  if (mesh.texture_corners.empty()) return result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t corner = mesh.texture_corners[face][i];
    if (corner != kNoIndex) result.uv[i] = TexturePoint(mesh.texture_coordinates[corner]);
  }
  return result;
}

/// A value at the corners, weighted: the first product, plus the second, plus the third.
template <class T>
T weighted(const T (&at_corners)[3], const DVector& weights) {
  return at_corners[0] * weights.x + at_corners[1] * weights.y + at_corners[2] * weights.z;
}

}  // namespace facemap
