#pragma once

#include <cmath>
#include <span>

namespace facemap {

/// A corner of a polygon in its own plane.
struct PlanePoint {
  float x, y;
  bool operator==(const PlanePoint&) const = default;
};

/// The two products whose difference is twice the signed area of the triangle a, b, c. Differences of floats are
/// rounded at most once and products of them cannot underflow, so each product is off by 3 roundings at most.
struct AreaProducts {
  double left, right;
  AreaProducts(PlanePoint a, PlanePoint b, PlanePoint c)
      : left((static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y)),
        right((static_cast<double>(b.y) - a.y) * (static_cast<double>(c.x) - a.x)) {}
  double magnitude() const { return std::abs(left) + std::abs(right); }
};

/// orientation where rounding leaves a doubt.
int exact_orientation(PlanePoint a, PlanePoint b, PlanePoint c);

/// 1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if they are on one line. Exact for finite points.
inline int orientation(PlanePoint a, PlanePoint b, PlanePoint c) {
  // 3 roundings a product; a fourth covers those of the bound itself.
  constexpr double kBound = 4 * 0x1p-53;
  const AreaProducts area(a, b, c);
  const double difference = area.left - area.right;
  if (std::abs(difference) > kBound * area.magnitude()) return difference > 0 ? 1 : -1;
  return exact_orientation(a, b, c);
}

/// The sign of the area that a polygon winds around, positive if counter-clockwise. Exact for finite points.
int orientation(std::span<const PlanePoint> polygon);

}  // namespace facemap
