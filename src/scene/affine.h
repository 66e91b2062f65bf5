#pragma once

#include <facemap/vector.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace facemap {

/// p -> p.x x + p.y y + p.z z + origin, in double precision.
struct Affine {
  DVector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  DVector origin{0};

  DVector direction(const DVector& d) const { return d.x * x + d.y * y + d.z * z; }
  DVector point(const DVector& p) const { return direction(p) + origin; }

  /// First `inner`, then this.
  Affine operator*(const Affine& inner) const {
    return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin)};
  }

  bool is_mirrored() const { return glm::dot(glm::cross(x, y), z) < 0; }

  /// Turns normals of surfaces: the inverse transposed, but for a positive factor.
  Affine of_normals() const {
    const double sign = is_mirrored() ? -1 : 1;
    return {sign * glm::cross(y, z), sign * glm::cross(z, x), sign * glm::cross(x, y), DVector(0)};
  }
};

/// `v` at unit length; zero if it has no direction.
inline DVector unit_or_zero(DVector v) {
  const bool is_finite = (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0;  // infinity less itself is NaN
  const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!is_finite || largest == 0) return DVector(0);
  v = v / largest;
  return v / std::sqrt(glm::dot(v, v));
}

}  // namespace facemap
