#pragma once

#include <facemap/vector.h>

namespace facemap {

/// How local directions meet the points of a map.
enum class ProjectionKind {
  Surface,  ///< linear surface projection, the paper's: distance from the centre is proportional to the angle
  Plane,    ///< perspective, the raster method's: eq. (1), (2)
};

/// A map of local directions (x right, y up, z along the sight) on width x height texels, and its inverse.
///
/// Surface: R = min(width, height)/2 texels span half the field angle (0 < field angle <= 2 pi); the scale goes
/// on in the corners up to 180 degrees from the axis. Plane: the field angle (0 < field angle < pi) is the full
/// vertical angle of view.
class Projection {
 public:
  /// `field_angle` in radians. Throws Error if it is out of range or a size is not in 1..32768.
  Projection(ProjectionKind kind, double field_angle, int width, int height);

  ProjectionKind kind() const noexcept { return kind_; }
  double field_angle() const noexcept { return field_angle_; }
  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }

  /// Field radius R in texels, min(width, height)/2. Wang 2022, eq. (14).
  double radius() const noexcept { return radius_; }

  /// Radians a texel at the centre. No texel is wider anywhere: both inverse maps shorten paths, never lengthen.
  double texel_angle() const noexcept { return texel_angle_; }

  /// Whether a local direction has a map point (plane: it points forwards). The zero vector has none.
  bool is_mapped(const DVector& local) const noexcept;

  /// Map point of a local direction that is_mapped, of any length. It may lie outside the raster.
  /// Surface: Wang 2022, eq. (13) to (16); on the axis the centre, at the antipode some point of the rim,
  /// strictly inside the raster at 360 degrees.
  MapPoint map_from_local(const DVector& local) const noexcept;

  /// Unit local direction of a map point. Surface: Wang 2022, eq. (17) to (22); beyond 180 degrees from the
  /// axis there is none: see has_direction.
  DVector local_from_map(const MapPoint& point) const noexcept;
  bool has_direction(const MapPoint& point) const noexcept;

  /// The computed map point of any direction is the exact image of a direction at most this far away (radians):
  /// the rotation into the frame, then one atan2 or division, then the scaling to texels; each below 2^-48 rad.
  /// Besides, the coordinates are rounded: by at most 2^-39 texels.
  static constexpr double kMapError = 0x1p-46;

 private:
  ProjectionKind kind_;
  double field_angle_;
  int width_, height_;
  double radius_;
  double texel_angle_;
};

}  // namespace facemap
