#pragma once

#include <facemap/affine.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace facemap {

/// `v` at unit length; zero if it has no direction.
inline DVector unit_or_zero(DVector v) {
  const bool is_finite = (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0;  // infinity less itself is NaN
  const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!is_finite || largest == 0) return DVector(0);
  v = v / largest;
  return v / std::sqrt(glm::dot(v, v));
}

}  // namespace facemap
