#include <facemap/error.h>
#include <facemap/lens.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <optional>

#include "math/dvector.h"

// Bytes as numbers: a camera matrix, eight coefficients, then places. Whatever is accepted keeps the bounds that it
// states.
namespace {

using facemap::DVector;
using facemap::Lens;
using facemap::MapPoint;

constexpr int kWidth = 640, kHeight = 480;

void check(bool holds) {
  if (!holds) __builtin_trap();
}

Lens lens_of(bool is_fisheye, const std::array<double, 12>& x) {
  const facemap::CameraMatrix matrix{x[0], x[1], x[2], x[3]};
  if (is_fisheye) return Lens::opencv_fisheye(matrix, {x[4], x[5], x[6], x[7]}, kWidth, kHeight);
  return Lens::opencv_pinhole(matrix, {x[4], x[5], x[6], x[7], x[8], x[9], x[10], x[11]}, kWidth, kHeight);
}

double share_of(std::uint16_t bits) { return bits * 0x1p-16; }

void check_place(const Lens& lens, const MapPoint& place, const MapPoint& other) {
  const std::optional<DVector> direction = lens.direction(place), second = lens.direction(other);
  if (!direction) return;
  check(std::fabs(facemap::length(*direction) - 1) < 1e-12);
  const MapPoint low(std::min(place.x, other.x), std::min(place.y, other.y));
  const MapPoint high(std::max(place.x, other.x), std::max(place.y, other.y));
  if (second) check(facemap::angle_between(*direction, *second) <= 2 * lens.cap_radius(low, high));

  const double error = 2 * lens.angle_error() + 4 * Lens::kPlaceError * lens.pixel_angle();
  const std::optional<MapPoint> again = lens.map_point(*direction);
  if (!again) {
    check(facemap::angle_between(*direction, {0, 0, 1}) >= lens.largest_angle() - error);
    return;
  }
  const std::optional<DVector> same = lens.direction(*again);
  if (same) check(facemap::angle_between(*direction, *same) <= error);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::array<double, 12> numbers{};
  constexpr std::size_t kHead = 1 + sizeof(numbers);
  if (size < kHead) return 0;
  std::memcpy(numbers.data(), data + 1, sizeof(numbers));
  try {
    const Lens lens = lens_of(data[0] & 1, numbers);
    for (std::size_t at = kHead; at + 8 <= size; at += 8) {
      std::uint16_t shares[4];
      std::memcpy(shares, data + at, sizeof(shares));
      const MapPoint place(share_of(shares[0]) * kWidth, share_of(shares[1]) * kHeight);
      const MapPoint step(share_of(shares[2]) * 16, share_of(shares[3]) * 16);
      check_place(lens, place, glm::min(place + step, MapPoint(kWidth, kHeight)));
    }
  } catch (const facemap::Error&) {
  }
  return 0;
}
