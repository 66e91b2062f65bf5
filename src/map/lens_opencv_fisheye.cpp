#include <facemap/error.h>

#include <cmath>
#include <memory>

#include "map/camera_matrix.h"
#include "map/lens_model.h"
#include "map/radial_curve.h"
#include "math/elementary.h"

namespace facemap {
namespace {

// J. Kannala, S. Brandt, "A generic camera model and calibration method", 2006, as cv::fisheye has it. OpenCV takes
// theta from an arc tangent of x/z and so ends at 90 degrees; the angle itself goes on to 180.
class FisheyeLens final : public LensModel {
 public:
  FisheyeLens(const CameraMatrix& matrix, const FisheyeDistortion& k, int width, int height)
      : LensModel(LensKind::OpenCVFisheye, width, height),
        plane_(matrix, width, height),
        theta_d_({1, k.k1, k.k2, k.k3, k.k4}, {1}, 0, elementary::kPi) {
    const double outermost = theta_d_.outer_radius(plane_.reach(MapPoint(0), MapPoint(width, height)));
    angle_error_ = Projection::kMapError * (1 + theta_d_.magnitude(outermost) / theta_d_.least_slope(outermost));
  }

  std::optional<DVector> direction(const MapPoint& place) const override {
    const MapPoint p = plane_.normalized(place);
    const double distance = std::sqrt(p.x * p.x + p.y * p.y);
    const double theta = theta_d_.radius(distance);
    if (!(theta <= theta_d_.end())) return std::nullopt;
    if (distance == 0) return DVector(0, 0, 1);
    const double sine = elementary::sin(theta) / distance;
    return DVector(p.x * sine, -p.y * sine, elementary::cos(theta));
  }

  std::optional<MapPoint> map_point(const DVector& local) const override {
    const double distance = std::sqrt(local.x * local.x + local.y * local.y);
    const double theta = elementary::atan2(distance, local.z);
    if (!(theta <= theta_d_.end())) return std::nullopt;
    const double scale = distance > 0 ? theta_d_.value(theta) / distance : 0;
    // Straight behind there is a whole circle: the place on its right serves.
    if (distance == 0 && local.z < 0) return plane_.place({theta_d_.value(theta), 0});
    return plane_.place({local.x * scale, -local.y * scale});
  }

  double largest_angle() const override { return theta_d_.end(); }

  // With theta as a distance from the centre in all directions, directions are at most as far apart as their images.
  double pixel_angle(const MapPoint& low, const MapPoint& high) const override {
    return plane_.scale() / theta_d_.least_slope(theta_d_.outer_radius(plane_.reach(low, high)));
  }

  double angle_error() const override { return angle_error_; }

 private:
  NormalizedPlane plane_;
  RadialCurve theta_d_;
  double angle_error_;
};

}  // namespace

FisheyeDistortion FisheyeDistortion::from_opencv(std::span<const double> c) {
  if (c.empty()) return {};
  if (c.size() != 4) throw Error("lens distortion of a fisheye must have 4 coefficients: k1, k2, k3, k4");
  return {c[0], c[1], c[2], c[3]};
}

LensModelPointer fisheye_lens(const CameraMatrix& matrix, const FisheyeDistortion& k, int width, int height) {
  check_coefficient("k1", k.k1);
  check_coefficient("k2", k.k2);
  check_coefficient("k3", k.k3);
  check_coefficient("k4", k.k4);
  return std::make_shared<const FisheyeLens>(matrix, k, width, height);
}

}  // namespace facemap
