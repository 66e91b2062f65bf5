#include "math/clip.h"

#include <cstddef>

namespace facemap {
namespace {

// Always from the inner to the outer end, whichever way the edge is walked: neighbours agree on the bits.
DVector crossing(const DVector& inner, const DVector& outer, double near) {
  const double s = (inner.z - near) / (inner.z - outer.z);
  return {inner.x + s * (outer.x - inner.x), inner.y + s * (outer.y - inner.y), near};
}

}  // namespace

// Sutherland and Hodgman 1974, for one plane.
void clip_at_near_plane(std::span<const DVector> polygon, double near, std::vector<DVector>& clipped) {
  clipped.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVector& a = polygon[i];
    const DVector& b = polygon[(i + 1) % polygon.size()];
    const bool a_inside = a.z >= near, b_inside = b.z >= near;
    if (a_inside) clipped.push_back(a);
    if (a_inside && !b_inside) clipped.push_back(crossing(a, b, near));
    if (!a_inside && b_inside) clipped.push_back(crossing(b, a, near));
  }
}

}  // namespace facemap
