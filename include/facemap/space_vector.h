#pragma once

#include <facemap/vector.h>

namespace facemap {

/// A point of space with axes of its own. Wang 2022, sec. 4.3: the Space vector class; sec. 4.2.1, 4.2.4.
///
/// World and file are right-handed; the local frame is the paper's left-handed one: x to the right, y up, z
/// along the line of sight, so det(axis_x, axis_y, axis_z) = -1 in world coordinates.
class SpaceVector {
 public:
  /// Axes may be off from orthonormal by this much (a component, no unit): what float32 input leaves after a
  /// few products. They are made orthonormal to double precision, keeping axis_z.
  static constexpr double kOrthonormalTolerance = 1e-5;

  /// Throws Error if the position is not finite, or the axes are not orthonormal or would mirror the picture
  /// (determinant +1).
  SpaceVector(const Vector& position, const DVector& axis_x, const DVector& axis_y, const DVector& axis_z);

  /// Sight from `position` towards `look_at`, right = normalize(sight x up), up' = right x sight. Throws Error
  /// if the two points are equal or `up` is parallel to the sight or zero.
  static SpaceVector looking_at(const Vector& position, const Vector& look_at, const Vector& up = Vector(0, 1, 0));

  /// As above with a sight direction; `up` falls back to +z or +x if it is parallel to the sight.
  static SpaceVector looking_along(const Vector& position, const DVector& sight);

  const Vector& position() const noexcept { return position_; }
  const DVector& axis_x() const noexcept { return axis_x_; }
  const DVector& axis_y() const noexcept { return axis_y_; }
  const DVector& axis_z() const noexcept { return axis_z_; }

  /// A world direction (an offset from position()) in local axes. Wang 2022, eq. (11), (12).
  DVector local_from_world(const DVector& direction) const noexcept;

  /// A local direction in world axes: the transpose. Wang 2022, eq. (23) to (26).
  /// Departs: the sign of the determinant decides nothing about solvability; for orthonormal axes the solution
  /// of eq. (23) is the transpose, whatever their handedness.
  DVector world_from_local(const DVector& direction) const noexcept;

 private:
  Vector position_;
  DVector axis_x_, axis_y_, axis_z_;
};

}  // namespace facemap
