#include "scene/affine.h"

#include <facemap/error.h>

#include <cmath>
#include <string>

#include "math/elementary.h"

namespace facemap {

namespace {

struct Turn {
  double cosine, sine;
};

/// Exact for whole quarter turns.
Turn turn_by(double degrees) {
  constexpr double kMostDegrees = 1e6;  // 17,454 radians: elementary::sin takes 2^20
  if (!(std::fabs(degrees) <= kMostDegrees)) throw Error("rotation: more than a million degrees, or no number");
  const double quarters = std::nearbyint(degrees / 90);
  const double rest = (degrees - 90 * quarters) * (elementary::kPi / 180);
  const Turn near = {elementary::cos(rest), elementary::sin(rest)};
  switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
    case 0:
      return near;
    case 1:
      return {-near.sine, near.cosine};
    case 2:
      return {-near.cosine, -near.sine};
    default:
      return {near.sine, -near.cosine};
  }
}

/// A unit vector at a right angle to `v`.
DVector perpendicular(const DVector& v) {
  const bool is_x_small = std::fabs(v.x) <= std::fabs(v.y) && std::fabs(v.x) <= std::fabs(v.z);
  const bool is_y_small = std::fabs(v.y) <= std::fabs(v.z);
  return unit_or_zero(glm::cross(v, is_x_small ? DVector(1, 0, 0) : is_y_small ? DVector(0, 1, 0) : DVector(0, 0, 1)));
}

/// Rodrigues' formula for a unit axis, applied to the three axes of coordinates.
Affine rotation_about(const DVector& axis, const Turn& turn) {
  const auto turned = [&](const DVector& v) {
    return turn.cosine * v + turn.sine * glm::cross(axis, v) + ((1 - turn.cosine) * glm::dot(axis, v)) * axis;
  };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), DVector(0)};
}

DVector unit_direction(const DVector& v, const char* what) {
  const DVector unit = unit_or_zero(v);
  if (unit == DVector(0)) throw Error(std::string(what) + ": a vector without a direction");
  return unit;
}

}  // namespace

Affine Affine::translation(const DVector& by) {
  Affine result;
  result.origin = by;
  return result;
}

Affine Affine::scaling(const DVector& factors) {
  return {{factors.x, 0, 0}, {0, factors.y, 0}, {0, 0, factors.z}, DVector(0)};
}

Affine Affine::rotation(const DVector& axis, double degrees) {
  return rotation_about(unit_direction(axis, "rotation: axis"), turn_by(degrees));
}

Affine Affine::turning(const DVector& from, const DVector& to) {
  const DVector a = unit_direction(from, "turning: from");
  const DVector b = unit_direction(to, "turning: to");
  const DVector cross = glm::cross(a, b);
  const double sine = std::sqrt(glm::dot(cross, cross));
  const double cosine = glm::dot(a, b);
  if (sine > 0) return rotation_about(cross / sine, {cosine, sine});
  return cosine > 0 ? Affine() : rotation_about(perpendicular(a), {-1, 0});
}

}  // namespace facemap
