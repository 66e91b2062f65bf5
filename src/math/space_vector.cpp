#include <facemap/error.h>
#include <facemap/space_vector.h>

#include <cmath>

#include "math/dvector.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

bool is_zero(const DVector& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

// Below this sine (no unit) two directions count as parallel: their cross product would be mostly rounding.
constexpr double kParallelSine = 1e-9;

}  // namespace

SpaceVector::SpaceVector(const Vector& position, const DVector& axis_x, const DVector& axis_y, const DVector& axis_z)
    : position_(position) {
  const FloatingPointMode mode;
  if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
    throw Error("position is not finite");
  }
  const double errors[] = {dot(axis_x, axis_x) - 1, dot(axis_y, axis_y) - 1, dot(axis_z, axis_z) - 1,
                           dot(axis_x, axis_y),     dot(axis_y, axis_z),     dot(axis_z, axis_x)};
  for (const double error : errors) {
    if (!(std::fabs(error) <= kOrthonormalTolerance)) throw Error("axes are not orthonormal");
  }
  if (!(dot(cross(axis_x, axis_y), axis_z) < 0)) {
    throw Error("axes would mirror the picture: det(right, up, sight) must be -1 in world coordinates");
  }
  axis_z_ = normalized(axis_z);
  axis_x_ = normalized(axis_x - dot(axis_x, axis_z_) * axis_z_);
  axis_y_ = cross(axis_x_, axis_z_);
}

SpaceVector SpaceVector::looking_at(const Vector& position, const Vector& look_at, const Vector& up) {
  const FloatingPointMode mode;
  const DVector sight = normalized(DVector(look_at) - DVector(position));
  if (is_zero(sight)) throw Error("camera position and the point it looks at are the same");
  const DVector right = cross(sight, normalized(DVector(up)));
  if (!(dot(right, right) > kParallelSine * kParallelSine)) throw Error("up is parallel to the line of sight, or zero");
  const DVector axis_x = normalized(right);
  return SpaceVector(position, axis_x, cross(axis_x, sight), sight);
}

SpaceVector SpaceVector::looking_along(const Vector& position, const DVector& sight) {
  const FloatingPointMode mode;
  const DVector z = normalized(sight);
  if (is_zero(z)) throw Error("sight direction is zero");
  // The world axis farthest from the sight, +y preferred, serves as up.
  const DVector up = std::fabs(z.y) < 0.9 ? DVector(0, 1, 0) : DVector(0, 0, 1);
  const DVector x = normalized(cross(z, up));
  return SpaceVector(position, x, cross(x, z), z);
}

DVector SpaceVector::local_from_world(const DVector& direction) const noexcept {
  // Wang 2022, eq. (11)
  return {dot(direction, axis_x_), dot(direction, axis_y_), dot(direction, axis_z_)};
}

DVector SpaceVector::world_from_local(const DVector& direction) const noexcept {
  // Wang 2022, eq. (26)
  return {axis_x_.x * direction.x + axis_y_.x * direction.y + axis_z_.x * direction.z,
          axis_x_.y * direction.x + axis_y_.y * direction.y + axis_z_.y * direction.z,
          axis_x_.z * direction.x + axis_y_.z * direction.y + axis_z_.z * direction.z};
}

}  // namespace facemap
