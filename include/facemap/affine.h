#pragma once

#include <facemap/vector.h>

#include <glm/geometric.hpp>

namespace facemap {

/// p -> p.x x + p.y y + p.z z + origin, in double precision.
struct Affine {
  DVector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  DVector origin{0};

  static Affine translation(const DVector& by);
  static Affine scaling(const DVector& factors);

  /// Counter-clockwise about an axis through the origin as seen from its tip. Whole quarter turns about an axis of
  /// coordinates move coordinates without rounding. Throws Error for an axis without a direction and for angles that
  /// are not finite or beyond a million degrees.
  static Affine rotation(const DVector& axis, double degrees);

  /// The shortest rotation that turns the direction `from` into `to`. Throws Error if one of them has none.
  static Affine turning(const DVector& from, const DVector& to);

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

  bool operator==(const Affine& other) const = default;
};

}  // namespace facemap
