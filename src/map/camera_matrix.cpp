#include "map/camera_matrix.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "map/lens_model.h"

namespace facemap {
namespace {

constexpr double kShortestFocalLength = 0x1p-20, kLongestFocalLength = 0x1p30;  // pixels
constexpr double kFarthestPrincipalPoint = 0x1p18;                              // pixels: keeps Lens::kPlaceError
constexpr double kLargestCoefficient = 0x1p20;
constexpr double kPixelCentre = 0.5;

void check_focal_length(const char* name, double value) {
  if (!(value > 0)) throw Error(std::string("camera matrix: ") + name + " must be above 0");
  if (!(value >= kShortestFocalLength && value <= kLongestFocalLength)) {
    throw Error(std::string("camera matrix: ") + name + " must be 2^-20 to 2^30 pixels");
  }
}

void check_principal_point(const char* name, double value) {
  if (!(std::fabs(value) <= kFarthestPrincipalPoint)) {
    throw Error(std::string("camera matrix: ") + name + " must be within 262144 pixels of the picture's corner");
  }
}

}  // namespace

void check_coefficient(const char* name, double value) {
  if (!(std::fabs(value) <= kLargestCoefficient)) {
    throw Error(std::string("lens distortion: ") + name + " must be a number within -1048576 and 1048576");
  }
}

NormalizedPlane::NormalizedPlane(const CameraMatrix& matrix, int width, int height)
    : fx_(matrix.fx), fy_(matrix.fy), middle_x_(matrix.cx + kPixelCentre), middle_y_(matrix.cy + kPixelCentre) {
  check_picture_size(width, height);
  check_focal_length("fx", matrix.fx);
  check_focal_length("fy", matrix.fy);
  check_principal_point("cx", matrix.cx);
  check_principal_point("cy", matrix.cy);
}

double NormalizedPlane::reach(const MapPoint& low, const MapPoint& high) const {
  const MapPoint a = normalized(low), b = normalized(high);
  const double x = std::max(std::fabs(a.x), std::fabs(b.x)), y = std::max(std::fabs(a.y), std::fabs(b.y));
  return std::sqrt(x * x + y * y) * (1 + 0x1p-40);
}

double NormalizedPlane::scale() const { return 1 / std::min(fx_, fy_); }

}  // namespace facemap
