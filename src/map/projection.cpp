#include <facemap/error.h>
#include <facemap/projection.h>

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

// The antipode's image is the whole rim, which touches the raster's border at 360 degrees. Angles are kept this
// share of pi short of it, so that the map point of every direction lies strictly inside; well below kMapError.
constexpr double kRimShare = 0x1p-50;
constexpr double kLargestBeta = elementary::kPi * (1 - kRimShare);

constexpr int kLargestSize = 32768;  // texels; keeps a texel's number within 32 bits

}  // namespace

Projection::Projection(ProjectionKind kind, double field_angle, int width, int height)
    : kind_(kind), field_angle_(field_angle), width_(width), height_(height) {
  const FloatingPointMode mode;
  if (width < 1 || height < 1 || width > kLargestSize || height > kLargestSize) {
    throw Error("map size must be 1 to 32768 texels a side");
  }
  const bool surface = kind == ProjectionKind::Surface;
  const double largest = surface ? 2 * elementary::kPi : elementary::kPi;
  if (!(field_angle > 0) || !(surface ? field_angle <= largest : field_angle < largest)) {
    throw Error(surface ? "field angle must be above 0 and at most 360 degrees"
                        : "field angle of a plane projection must be above 0 and below 180 degrees");
  }
  radius_ = std::min(width, height) * 0.5;
  texel_angle_ = surface ? field_angle / (2 * radius_) : elementary::tan(field_angle / 2) / (height * 0.5);
}

bool Projection::is_mapped(const DVector& local) const noexcept {
  if (kind_ == ProjectionKind::Plane) return local.z > 0;
  return local.x != 0 || local.y != 0 || local.z != 0;
}

MapPoint Projection::map_from_local(const DVector& local) const noexcept {
  const double centre_x = width_ * 0.5, centre_y = height_ * 0.5;
  if (kind_ == ProjectionKind::Plane) {
    // Wang 2022, eq. (1), (2) without near and far: they order depths, and exact depths need no order.
    const double scale = 1 / (local.z * texel_angle_);
    return {centre_x + local.x * scale, centre_y - local.y * scale};
  }
  // Departs: eq. (13) takes beta from an arccosine, which loses digits near the axis.
  const double distance = std::sqrt(local.x * local.x + local.y * local.y);
  const double beta = std::min(elementary::atan2(distance, local.z), kLargestBeta);
  const double t = beta / texel_angle_;  // eq. (14): 2 beta / theta * R
  // Departs: eq. (15) is 0/0 on the axis; there any direction in the map serves.
  const double kx = distance > 0 ? local.x / distance : 1;
  const double ky = distance > 0 ? local.y / distance : 0;
  return {centre_x + t * kx, centre_y - t * ky};  // eq. (16), with offset and flip
}

bool Projection::has_direction(const MapPoint& point) const noexcept {
  if (kind_ == ProjectionKind::Plane) return true;
  const double dx = point.x - width_ * 0.5, dy = height_ * 0.5 - point.y;
  return std::sqrt(dx * dx + dy * dy) * texel_angle_ <= elementary::kPi;
}

DVector Projection::local_from_map(const MapPoint& point) const noexcept {
  const double dx = point.x - width_ * 0.5, dy = height_ * 0.5 - point.y;
  if (kind_ == ProjectionKind::Plane) {
    const double x = dx * texel_angle_, y = dy * texel_angle_;
    const double scale = 1 / std::sqrt(x * x + y * y + 1);
    return {x * scale, y * scale, scale};
  }
  const double r = std::sqrt(dx * dx + dy * dy);
  const double beta = r * texel_angle_;    // Wang 2022, eq. (17)
  const double z = elementary::cos(beta);  // eq. (18)
  if (r == 0) return {0, 0, z};
  // Departs: eq. (21), (22) keep the positive root alone, which mirrors the left half, and divide by dx.
  const double s = elementary::sin(beta) / r;
  return {s * dx, s * dy, z};
}

}  // namespace facemap
