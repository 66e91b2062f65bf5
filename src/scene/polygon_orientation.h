#pragma once

#include <span>

namespace facemap {

/// A corner of a polygon in its own plane.
struct PlanePoint {
  float x, y;
  bool operator==(const PlanePoint&) const = default;
};

/// 1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if they are on one line. Exact for finite points.
int orientation(PlanePoint a, PlanePoint b, PlanePoint c);

/// The sign of the area that a polygon winds around, positive if counter-clockwise. Exact for finite points.
int orientation(std::span<const PlanePoint> polygon);

}  // namespace facemap
