#pragma once

#include <cstddef>

namespace facemap {

/// What ways of asking about points take, in nanoseconds of one thread, as measured on scenes of 10^4 to 10^6 faces.
/// They decide which way is taken, never what is answered.
struct PointCosts {
  std::size_t faces;

  double by_faces(std::size_t points) const { return 12 * count(faces) + 45 * count(points); }
  double by_bounds(std::size_t points) const { return 25 * count(points); }
  double by_lists(std::size_t points) const { return 250 * count(points); }
  double making_bounds() const { return 450 * count(faces); }
  double making_lists() const { return 700 * count(faces); }

 private:
  static double count(std::size_t n) { return static_cast<double>(n); }
};

}  // namespace facemap
