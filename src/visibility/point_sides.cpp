#include "visibility/point_sides.h"

#include <algorithm>
#include <cmath>

namespace facemap {
namespace {

constexpr std::size_t kFewestPoints = 32768;  // a task

// Bit 0 along the axis, bit 1 against it.
int bits_along(float offset) { return offset < 0 ? 2 : 1; }

}  // namespace

// Which side a point on the rim of two comes to makes no difference to answers, so float32 is good enough.
UnsetVector<std::uint8_t> sides_of_points(const AskedPoints& points, const Vector& origin, const Executor& executor) {
  UnsetVector<std::uint8_t> sides;
  sides.resize(points.size());
  const DVector offset = (points.origin - DVector(origin)) / points.step;
  const auto at_x = static_cast<float>(offset.x), at_y = static_cast<float>(offset.y),
             at_z = static_cast<float>(offset.z);
  for_ranges(executor, points.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    const std::int32_t *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    std::uint8_t* to = sides.data();
    for (std::size_t i = first; i < last; ++i) {
      const float X = static_cast<float>(x[i]) + at_x, Y = static_cast<float>(y[i]) + at_y,
                  Z = static_cast<float>(z[i]) + at_z;
      const float size_x = std::fabs(X), size_y = std::fabs(Y), size_z = std::fabs(Z);
      const int along_xy = size_y > size_x ? bits_along(Y) << 2 : bits_along(X);
      to[i] = static_cast<std::uint8_t>(size_z > std::max(size_x, size_y) ? bits_along(Z) << 4 : along_xy);
    }
  });
  return sides;
}

}  // namespace facemap
