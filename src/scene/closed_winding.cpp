#include "scene/closed_winding.h"

#include <algorithm>
#include <cmath>

namespace facemap {

WindingRay::WindingRay(const Vector& from, const DVector& centre, int direction) : from_(from) {
  // Of no meaning, but for being primes: edges of models made on a grid are not met.
  constexpr float kSteps[] = {1021, 577, 769, 1021, 577};
  for (int axis = 0; axis < 3; ++axis) {
    along_[axis] = double(from[axis]) >= centre[axis] ? kSteps[direction + axis] : -kSteps[direction + axis];
  }
}

std::optional<int> WindingRay::crossing(const Triangle& face) const {
  if (!may_meet(face)) return 0;
  const int s = side(face, from_);
  if (s == 0) {
    // The ray is in the face's plane, or meets it where it starts. All edge signs agree in the first case, and in the
    // second if that is on the face.
    if (covers(face, 1, from_, along_).hit || covers(face, -1, from_, along_).hit) return std::nullopt;
    return 0;
  }
  const Covering covering = covers(face, s, from_, along_);
  if (!covering.hit) return 0;
  if (!covering.strictly_inside) return std::nullopt;
  return s;
}

/// False only if the ray surely does not meet the closed triangle.
bool WindingRay::may_meet(const Triangle& face) const {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({face[0][axis], face[1][axis], face[2][axis]});
    if (along_[axis] > 0 ? high < from_[axis] : low > from_[axis]) return false;
  }
  return !surely_passes(face, 0, 1) && !surely_passes(face, 1, 2);
}

/// Seen along a third axis, all corners lie on one side of the ray's line: products of differences of floats and a
/// small integer, rounded to double, are off by less than 2^-50 of the sum of their magnitudes.
bool WindingRay::surely_passes(const Triangle& face, int first, int second) const {
  bool all_left = true, all_right = true;
  for (const Vector& corner : face) {
    const double p = double(along_[first]) * (double(corner[second]) - double(from_[second]));
    const double q = double(along_[second]) * (double(corner[first]) - double(from_[first]));
    const double error = 0x1p-50 * (std::fabs(p) + std::fabs(q));
    all_left &= p - q > error;
    all_right &= p - q < -error;
  }
  return all_left || all_right;
}

}  // namespace facemap
