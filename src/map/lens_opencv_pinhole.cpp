#include <facemap/error.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "map/camera_matrix.h"
#include "map/lens_model.h"
#include "map/radial_curve.h"
#include "math/elementary.h"
#include "math/rising_root.h"

namespace facemap {
namespace {

// In focal lengths from the axis: a direction within 2^-40 of 90 degrees from the sight has no place.
constexpr double kFarthestRadius = 0x1p40;

double length(const MapPoint& p) { return std::sqrt(p.x * p.x + p.y * p.y); }

double dot(const MapPoint& a, const MapPoint& b) { return a.x * b.x + a.y * b.y; }

// cv::projectPoints without thin prism and tilt. With w = (x/z, y/z) in its axes, r = |w|, q = (p2, p1) and R the
// radial curve, its formula is F(w) = (R(r)/r + 2 q.w) w + r^2 q.
class PinholeLens final : public LensModel {
 public:
  PinholeLens(const CameraMatrix& matrix, const PinholeDistortion& k, int width, int height)
      : LensModel(LensKind::OpenCVPinhole, width, height),
        plane_(matrix, width, height),
        radial_({1, k.k1, k.k2, k.k3}, {1, k.k4, k.k5, k.k6}, length({k.p2, k.p1}), kFarthestRadius),
        q_(k.p2, k.p1) {
    const double outermost = radial_.outer_radius(plane_.reach(MapPoint(0), MapPoint(width, height)));
    angle_error_ = Projection::kMapError * (1 + radial_.magnitude(outermost) / radial_.least_slope(outermost));
  }

  std::optional<DVector> direction(const MapPoint& place) const override {
    const std::optional<MapPoint> w = undistorted(plane_.normalized(place));
    if (!w) return std::nullopt;
    const double scale = 1 / std::sqrt(w->x * w->x + w->y * w->y + 1);
    return DVector(w->x * scale, -w->y * scale, scale);
  }

  std::optional<MapPoint> map_point(const DVector& local) const override {
    if (!(local.z > 0)) return std::nullopt;
    const MapPoint w(local.x / local.z, -local.y / local.z);
    if (!(length(w) <= radial_.end())) return std::nullopt;
    return plane_.place(distorted(w));
  }

  double largest_angle() const override { return elementary::atan2(radial_.end(), 1); }

  // The way from a plane to directions shortens every path.
  double pixel_angle(const MapPoint& low, const MapPoint& high) const override {
    return plane_.scale() / radial_.least_slope(radial_.outer_radius(plane_.reach(low, high)));
  }

  double angle_error() const override { return angle_error_; }

 private:
  // As OpenCV's documentation has it.
  MapPoint distorted(const MapPoint& w) const {
    const double p1 = q_.y, p2 = q_.x, x = w.x, y = w.y, r2 = dot(w, w);
    const double radial = radial_.factor(r2);
    return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  }

  // F(w) = u says that w lies along u - r^2 q, of which the length must be R(r) + 2 r^2 q.e with e its direction: one
  // equation for r. Where both sides agree their difference rises, by det F' over F' across e, which is positive in the
  // field: so there is at most one root, and signs bracket it (docs/cameras.md).
  std::optional<MapPoint> undistorted(const MapPoint& u) const {
    const auto f = [&](double r) {
      const MapPoint along = u - r * r * q_;
      const double distance = length(along);
      const double qe = distance > 0 ? dot(q_, along) / distance : 0;
      const double across = distance > 0 ? (q_.x * along.y - q_.y * along.x) / distance : 0;
      return ValueAndSlope{radial_.value(r) + 2 * r * r * qe - distance,
                           radial_.slope(r) + 6 * r * qe - 4 * r * r * r * across * across / distance};
    };
    const double reach = length(u);
    if (reach == 0) return MapPoint(0);
    double high = std::min(radial_.end(), reach);
    while (high < radial_.end() && f(high).value < 0) high = std::min(radial_.end(), 2 * high);
    if (!(f(high).value >= 0)) return std::nullopt;
    const double r = rising_root(f, 0, high, reach);
    const MapPoint along = u - r * r * q_;
    return along * (r / length(along));
  }

  NormalizedPlane plane_;
  RadialCurve radial_;
  MapPoint q_;
  double angle_error_;
};

}  // namespace

PinholeDistortion PinholeDistortion::from_opencv(std::span<const double> c) {
  const std::size_t count = c.size();
  if (count != 0 && count != 4 && count != 5 && count != 8 && count != 12 && count != 14) {
    throw Error("lens distortion of a pinhole must have 4, 5 or 8 coefficients: k1, k2, p1, p2, k3, k4, k5, k6");
  }
  for (std::size_t i = 8; i < count; ++i) {
    if (c[i] != 0) throw Error("lens distortion: thin prism (s1 to s4) and tilt (tau) are not supported");
  }
  double k[8] = {};
  std::copy_n(c.begin(), std::min<std::size_t>(count, 8), k);
  return {k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]};
}

LensModelPointer pinhole_lens(const CameraMatrix& matrix, const PinholeDistortion& k, int width, int height) {
  check_coefficient("k1", k.k1);
  check_coefficient("k2", k.k2);
  check_coefficient("p1", k.p1);
  check_coefficient("p2", k.p2);
  check_coefficient("k3", k.k3);
  check_coefficient("k4", k.k4);
  check_coefficient("k5", k.k5);
  check_coefficient("k6", k.k6);
  return std::make_shared<const PinholeLens>(matrix, k, width, height);
}

}  // namespace facemap
