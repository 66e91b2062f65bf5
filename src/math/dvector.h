#pragma once

#include <facemap/vector.h>

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

/// Products of double-precision vectors, in one fixed order of operations.
namespace facemap {

inline double dot(const DVector& a, const DVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline DVector cross(const DVector& a, const DVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const DVector& a) { return std::sqrt(dot(a, a)); }

/// Of unit length; the zero vector stays zero. Divides by the largest component first, so that no square
/// overflows or vanishes.
inline DVector normalized(const DVector& a) {
  const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  if (!(largest > 0)) return DVector(0);
  const DVector scaled = a / largest;
  return scaled / length(scaled);
}

/// Radians, 0 to pi; accurate for small angles too. 0 if either vector is zero.
inline double angle_between(const DVector& a, const DVector& b) {
  return elementary::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace facemap
