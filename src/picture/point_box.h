#pragma once

#include <facemap/vector.h>

#include <cmath>

namespace facemap {

/// An axis-parallel box of points; empty at first.
struct PointBox {
  DVector lower{HUGE_VAL}, upper{-HUGE_VAL};

  bool is_empty() const { return !(lower.x <= upper.x); }
  void add(const PointBox& other);

  DVector middle() const { return (lower + upper) * 0.5; }

  /// The farthest that a coordinate of a point of the box is from one of `centre`.
  double reach_from(const DVector& centre) const;
};

/// 2^k for the least k with x < 2^k; x positive and normal.
double power_of_two_above(double x);

}  // namespace facemap
