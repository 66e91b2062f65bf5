#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace facemap {

/// What ways of asking about points take, in nanoseconds of one thread, as measured on scenes of 10^5 faces with points
/// on them. They decide which way is taken, never what is answered.
class PointCosts {
 public:
  explicit PointCosts(std::size_t faces) : faces_(static_cast<double>(faces)) {}

  /// All faces are passed over; the more points there are, the more faces are held against some.
  double by_faces(std::size_t points) const {
    const double n = static_cast<double>(points);
    return (10 + 26 * std::sqrt(std::min(1.0, n / faces_))) * faces_ + 45 * n;
  }
  double by_lists(std::size_t points) const { return 120 * static_cast<double>(points); }
  double saved_by_bounds(std::size_t points) const { return 10 * static_cast<double>(points); }

  double making_lists() const { return 850 * faces_; }
  double making_bounds() const { return 350 * faces_; }

 private:
  double faces_;
};

}  // namespace facemap
