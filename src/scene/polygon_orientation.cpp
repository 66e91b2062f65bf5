#include "scene/polygon_orientation.h"

#include <cstddef>
#include <vector>

namespace facemap {

namespace {

int sign(double x) { return (x > 0) - (x < 0); }

/// A sum of doubles without any rounding: a list of doubles, by ascending magnitude, no two of which share a bit
/// place; so the last one has the sum's sign. After Shewchuk 1997, "Adaptive precision floating-point arithmetic
/// and fast robust geometric predicates": two-sum and grow-expansion.
class ExactSum {
 public:
  void add(double term) {
    std::size_t kept = 0;
    for (const double part : parts_) {
      const double sum = term + part;
      const double part_in_sum = sum - term;
      const double rest = (term - (sum - part_in_sum)) + (part - part_in_sum);
      if (rest != 0) parts_[kept++] = rest;
      term = sum;
    }
    parts_.resize(kept);
    if (term != 0) parts_.push_back(term);
  }

  /// Adds a.x b.y - a.y b.x; a product of two floats is exact in double.
  void add_cross(PlanePoint a, PlanePoint b) {
    add(static_cast<double>(a.x) * b.y);
    add(-static_cast<double>(a.y) * b.x);
  }

  int sign() const { return parts_.empty() ? 0 : facemap::sign(parts_.back()); }

 private:
  std::vector<double> parts_;
};

}  // namespace

int exact_orientation(PlanePoint a, PlanePoint b, PlanePoint c) {
  ExactSum exact;
  exact.add_cross(a, b);
  exact.add_cross(b, c);
  exact.add_cross(c, a);
  return exact.sign();
}

int orientation(std::span<const PlanePoint> polygon) {
  double sum = 0, magnitude = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const AreaProducts area(polygon[0], polygon[i - 1], polygon[i]);
    sum += area.left - area.right;
    magnitude += area.magnitude();
  }
  // 4 roundings a term and one more for each sum it goes through, doubled to cover those of the bound itself.
  const double bound = 2 * (static_cast<double>(polygon.size()) + 4) * 0x1p-53 * magnitude;
  if (std::abs(sum) > bound) return sign(sum);

  ExactSum exact;
  for (std::size_t i = 0; i < polygon.size(); ++i) exact.add_cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return exact.sign();
}

}  // namespace facemap
