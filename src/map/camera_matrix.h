#pragma once

#include <facemap/lens.h>

namespace facemap {

/// Between places of a picture and OpenCV's normalized image coordinates, x to the right and y downwards, both 1 at
/// one focal length. The one place where OpenCV's pixels become ours: the centre of the upper left one is (0, 0) there,
/// (0.5, 0.5) here.
class NormalizedPlane {
 public:
  /// Throws Error for a matrix or a size out of range.
  NormalizedPlane(const CameraMatrix& matrix, int width, int height);

  MapPoint normalized(const MapPoint& place) const {
    return {(place.x - middle_x_) / fx_, (place.y - middle_y_) / fy_};
  }

  MapPoint place(const MapPoint& normalized) const {
    return {middle_x_ + fx_ * normalized.x, middle_y_ + fy_ * normalized.y};
  }

  /// Upper bound of a place's distance from the principal point, normalized, over a box.
  double reach(const MapPoint& low, const MapPoint& high) const;

  /// No two places are farther apart normalized than this times their distance in pixels.
  double scale() const;

 private:
  double fx_, fy_, middle_x_, middle_y_;
};

/// Throws Error if a coefficient, by its name, is not within -2^20..2^20.
void check_coefficient(const char* name, double value);

}  // namespace facemap
