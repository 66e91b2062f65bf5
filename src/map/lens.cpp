#include <facemap/error.h>
#include <facemap/lens.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/lens_model.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr int kLargestSize = 32768;           // pixels; as Projection
constexpr double kFarthestPlace = 0x1p30;     // pixels
constexpr double kLargestLength = 0x1p400;    // a component's square stays finite
constexpr double kSmallestLength = 0x1p-400;  // and does not vanish

bool is_near(const MapPoint& place) {
  return std::fabs(place.x) <= kFarthestPlace && std::fabs(place.y) <= kFarthestPlace;
}

// Powers of two change no digit.
DVector without_extremes(const DVector& local, double largest) {
  if (largest > kLargestLength) return local * 0x1p-600;
  if (largest < kSmallestLength) return local * 0x1p600;
  return local;
}

}  // namespace

void check_picture_size(int width, int height) {
  if (width < 1 || height < 1 || width > kLargestSize || height > kLargestSize) {
    throw Error("picture size must be 1 to 32768 pixels a side");
  }
}

Lens::Lens(std::shared_ptr<const LensModel> model) : model_(std::move(model)) {}

Lens::Lens(const Projection& projection) : Lens(projection_lens(projection)) {}

Lens Lens::surface(double field_angle, int width, int height) {
  return Projection(ProjectionKind::Surface, field_angle, width, height);
}

Lens Lens::plane(double field_angle, int width, int height) {
  return Projection(ProjectionKind::Plane, field_angle, width, height);
}

Lens Lens::equirectangular(int width, int height) {
  const FloatingPointMode mode;
  return Lens(equirectangular_lens(width, height));
}

Lens Lens::cube_map(CubeLayout layout, int face_size) { return Lens(cube_lens(layout, face_size)); }

Lens Lens::opencv_pinhole(const CameraMatrix& matrix, const PinholeDistortion& distortion, int width, int height) {
  const FloatingPointMode mode;
  return Lens(pinhole_lens(matrix, distortion, width, height));
}

Lens Lens::opencv_fisheye(const CameraMatrix& matrix, const FisheyeDistortion& distortion, int width, int height) {
  const FloatingPointMode mode;
  return Lens(fisheye_lens(matrix, distortion, width, height));
}

LensKind Lens::kind() const noexcept { return model_->kind(); }
int Lens::width() const noexcept { return model_->width(); }
int Lens::height() const noexcept { return model_->height(); }
const Projection* Lens::projection() const noexcept { return model_->projection(); }
int Lens::piece_width() const noexcept { return model_->piece_width(); }
int Lens::piece_height() const noexcept { return model_->piece_height(); }
double Lens::largest_angle() const noexcept { return model_->largest_angle(); }
double Lens::angle_error() const noexcept { return model_->angle_error(); }

std::optional<DVector> Lens::direction(const MapPoint& place) const noexcept {
  if (!is_near(place)) return std::nullopt;
  return model_->direction(place);
}

std::optional<MapPoint> Lens::map_point(const DVector& local) const noexcept {
  const double largest = std::max({std::fabs(local.x), std::fabs(local.y), std::fabs(local.z)});
  const bool is_finite = std::isfinite(local.x) && std::isfinite(local.y) && std::isfinite(local.z);
  if (!is_finite || !(largest > 0)) return std::nullopt;
  const std::optional<MapPoint> place = model_->map_point(without_extremes(local, largest));
  return place && is_near(*place) ? place : std::nullopt;
}

double Lens::pixel_angle(const MapPoint& low, const MapPoint& high) const noexcept {
  return model_->pixel_angle(low, high);
}

double Lens::pixel_angle() const noexcept {
  return model_->pixel_angle(MapPoint(0), MapPoint(model_->width(), model_->height()));
}

double Lens::cap_radius(const MapPoint& low, const MapPoint& high) const noexcept {
  // Of a direction in the box the exact place is a hair outside of it: so is the box that bounds a pixel's angle.
  const MapPoint hair(2 * kPlaceError);
  const double dx = high.x - low.x, dy = high.y - low.y;
  const double reach = (0.5 * std::sqrt(dx * dx + dy * dy) + 4 * kPlaceError) * (1 + 0x1p-40);
  return reach * pixel_angle(low - hair, high + hair) + 2 * angle_error();
}

}  // namespace facemap
