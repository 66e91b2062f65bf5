#include <facemap/error.h>
#include <facemap/turntable.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr double kTurn = 6.28318530717958648;

/// `offset` turned about the unit vector `axis` by `angle`.
DVector turned(const DVector& offset, const DVector& axis, double angle) {
  const DVector along = axis * glm::dot(axis, offset);
  return along + (offset - along) * elementary::cos(angle) + glm::cross(axis, offset) * elementary::sin(angle);
}

}  // namespace

std::vector<View> turntable(const View& first, int count) {
  const FloatingPointMode mode;
  const DVector up(first.up);
  const double length = std::sqrt(glm::dot(up, up));
  if (!(length > 0) || !std::isfinite(length)) throw Error("a turntable needs a direction that points up");
  if (count < 1) throw Error("a turntable needs one view at least");
  const DVector centre(first.look_at);
  std::vector<View> views(static_cast<std::size_t>(count), first);
  for (int i = 1; i < count; ++i) {
    const DVector offset = turned(DVector(first.position) - centre, up / length, kTurn * i / count);
    views[static_cast<std::size_t>(i)].position = Vector(centre + offset);
  }
  return views;
}

}  // namespace facemap
