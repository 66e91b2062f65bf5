#include <algorithm>
#include <cmath>
#include <memory>

#include "map/lens_model.h"
#include "math/elementary.h"

namespace facemap {
namespace {

using elementary::kPi;

// Longitude from the sight to the right, -pi at the left border to pi at the right one; latitude pi/2 at the top.
class EquirectangularLens final : public LensModel {
 public:
  EquirectangularLens(int width, int height)
      : LensModel(LensKind::Equirectangular, width, height), column_angle_(2 * kPi / width), row_angle_(kPi / height) {}

  std::optional<DVector> direction(const MapPoint& place) const override {
    if (!(place.x >= 0 && place.x <= width() && place.y >= 0 && place.y <= height())) return std::nullopt;
    const double longitude = (place.x - width() * 0.5) * column_angle_;
    const double latitude = (height() * 0.5 - place.y) * row_angle_;
    const double across = elementary::cos(latitude);
    return DVector(across * elementary::sin(longitude), elementary::sin(latitude), across * elementary::cos(longitude));
  }

  std::optional<MapPoint> map_point(const DVector& local) const override {
    const double longitude = elementary::atan2(local.x, local.z);
    const double latitude = elementary::atan2(local.y, std::sqrt(local.x * local.x + local.z * local.z));
    const double x = width() * 0.5 + longitude / column_angle_;
    const double y = height() * 0.5 - latitude / row_angle_;
    // What is straight behind is at the left border; straight down is just above the lower one.
    return MapPoint(x < width() ? std::max(x, 0.0) : 0.0, std::clamp(y, 0.0, just_below(height())));
  }

  double largest_angle() const override { return kPi; }

  // A path on the picture is stretched by row_angle along y and by cos(latitude) column_angle along x.
  double pixel_angle(const MapPoint&, const MapPoint&) const override { return std::max(column_angle_, row_angle_); }

  // Two arc tangents or four sines and cosines of angles off by 2^-50: below 2^-47 in all.
  double angle_error() const override { return Projection::kMapError; }

 private:
  double column_angle_, row_angle_;  // radians a pixel
};

}  // namespace

LensModelPointer equirectangular_lens(int width, int height) {
  check_picture_size(width, height);
  return std::make_shared<const EquirectangularLens>(width, height);
}

}  // namespace facemap
