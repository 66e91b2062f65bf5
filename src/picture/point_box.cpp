#include "picture/point_box.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace facemap {

void PointBox::add(const PointBox& other) {
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = std::min(lower[axis], other.lower[axis]);
    upper[axis] = std::max(upper[axis], other.upper[axis]);
  }
}

double PointBox::reach_from(const DVector& centre) const {
  double reach = 0;
  for (int axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, centre[axis] - lower[axis], upper[axis] - centre[axis]});
  }
  return reach;
}

double power_of_two_above(double x) {
  return std::bit_cast<double>(((std::bit_cast<std::uint64_t>(x) >> 52) + 1) << 52);
}

}  // namespace facemap
