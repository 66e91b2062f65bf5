#include "picture/place_points.h"

#include <algorithm>
#include <cstdint>

#include "picture/point_box.h"

namespace facemap {
namespace {

constexpr double kLeastHalf = 0x1p-160;  // world units, below the least float: of a box that is one point

// To nearest, ties to even, for magnitudes up to 2^31: what is added leaves no room for a fraction.
std::int32_t rounded(double x) {
  constexpr double kMagic = 0x1.8p52;
  return static_cast<std::int32_t>((x + kMagic) - kMagic);
}

constexpr std::size_t kFewestPoints = 16384;  // a task

void place(const Vector& position, AskedPoints& points, std::size_t i) {
  const DVector steps = (DVector(position) - points.origin) * (1 / points.step);
  points.x[i] = rounded(steps.x);
  points.y[i] = rounded(steps.y);
  points.z[i] = rounded(steps.z);
}

}  // namespace

void place_points(const std::vector<Vector>& positions, const Executor& executor, AskedPoints& points) {
  const std::size_t count = positions.size();
  points.faces.assign(count, kNoOwnFace);
  for (auto* coordinates : {&points.x, &points.y, &points.z}) coordinates->resize(count);
  if (count == 0) return;
  Vector lower = positions[0], upper = positions[0];
  for (const Vector& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  }
  points.origin = (DVector(lower) + DVector(upper)) * 0.5;
  const DVector half = DVector(upper) - points.origin;
  points.step = power_of_two_above(std::max({half.x, half.y, half.z, kLeastHalf})) * 0x1p-30;
  // Half a step for each coordinate, sqrt(3) / 2 < 0.8661 for three; the difference from the origin is rounded by
  // 2^-53 of at most 2^30 steps.
  points.error = 0.8662 * points.step;
  for_ranges(executor, count, kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) place(positions[i], points, i);
  });
}

}  // namespace facemap
