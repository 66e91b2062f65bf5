#pragma once

#include <cmath>

#include "math/dvector.h"
#include "math/elementary.h"

namespace facemap {

/// An upper bound of the angle between unit vectors a chord apart. asin(x)/x is convex in x^2 and pi/3 at x = 1/2, so
/// for chords up to 1 it lies below 1 + (pi/3 - 1) chord^2; longer chords are taken for any angle.
inline double angle_of_chord(double chord) {
  if (!(chord <= 1)) return elementary::kPi;
  return chord * (1 + 0.0472 * chord * chord);
}

/// Directions within an angle of a unit vector.
struct DirectionCap {
  DVector centre{0, 0, 1};
  double radius = elementary::kPi;  ///< radians
  double sine = 2;                  ///< of the radius, rounded up; from 90 degrees on more than any

  DirectionCap() = default;
  DirectionCap(const DVector& unit, double angle)
      : centre(unit), radius(angle), sine(angle < elementary::kPi / 2 ? elementary::sin(angle) + kSlack : 2) {}

  /// Roundings of centres and sums of doubles, all of size 1.
  static constexpr double kSlack = 0x1p-44;
};

}  // namespace facemap
