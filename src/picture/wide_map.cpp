#include "picture/wide_map.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace facemap {
namespace {

constexpr int kLargestMap = 1024;  // texels a side

// Of any ray from the sight (radians).
double largest_angle(const Lens& lens) {
  const Projection* projection = lens.projection();
  if (projection == nullptr) return lens.largest_angle();
  const double half_width = projection->width() * 0.5 * projection->texel_angle();
  const double half_height = projection->height() * 0.5 * projection->texel_angle();
  const double reach = std::sqrt(half_width * half_width + half_height * half_height);
  return projection->kind() == ProjectionKind::Plane ? elementary::atan2(reach, 1) : reach;
}

}  // namespace

Camera::Options wide_map(const Lens& lens) {
  constexpr double kRoundedDirection = 0x1p-20;  // radians: float32, and what doubles lose
  Camera::Options options;
  options.projection = ProjectionKind::Surface;
  options.field_angle = std::min(2 * elementary::kPi, 2 * (largest_angle(lens) * (1 + 0x1p-10) + kRoundedDirection));
  options.width = options.height = std::clamp(std::max(lens.width(), lens.height()), 1, kLargestMap);
  return options;
}

}  // namespace facemap
