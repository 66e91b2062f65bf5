#pragma once

#include <array>
#include <vector>

namespace facemap {

/// The radial part of a lens with distortion, R(r) = r N(r^2) / D(r^2): where it rises, and how steeply at least.
///
/// Next to it there may be a tangential part, of which `bend` is sqrt(p1^2 + p2^2). The map of the plane that is made
/// of both, F, is the gradient of a function: its derivative is a symmetric matrix, of which the radial part has the
/// eigenvalues R' and R/r and the tangential one none below -6 bend r. So F is one to one on each disc where
/// g = min(R', R/r) - 6 bend r is positive, and |F(a) - F(b)| >= |a - b| min g there (docs/cameras.md).
class RadialCurve {
 public:
  /// The field ends where g falls to this, 1 being its value at the centre: a fold but for a ring that fills less than
  /// a thousandth of a pixel (docs/cameras.md). Or where D falls to this share of the sum of its terms' magnitudes: a
  /// pole.
  static constexpr double kLeastSlope = 0x1p-10;

  static constexpr int kMostTerms = 5;

  /// N and D in ascending powers of r^2, the first of each is 1. The field ends at `limit` at the latest.
  RadialCurve(const std::array<double, kMostTerms>& numerator, const std::array<double, kMostTerms>& denominator,
              double bend, double limit);

  double value(double r) const;
  double slope(double r) const;

  /// N/D, which is R(r)/r, as OpenCV's formula has it.
  double factor(double r_squared) const;

  /// Where the field ends; its end is part of it.
  double end() const { return end_; }

  /// The r of the field with R(r) = target >= 0; infinity if there is none.
  double radius(double target) const;

  /// Upper bound of |a| in the field for |F(a)| <= reach.
  double outer_radius(double reach) const;

  /// Lower bound of g on 0..r, at most a quarter below the greatest one; r beyond the field counts as its end.
  double least_slope(double r) const;

  /// Upper bound of what errors of F are relative to, on 0..r: the sum of the magnitudes of its terms.
  double magnitude(double r) const;

 private:
  struct Level {
    double slope;   // g is above this
    double radius;  // for all r up to here
  };

  void find_levels(double limit);
  double range_above(double level) const;
  double rising_radius(double target, double pull) const;

  std::vector<double> numerator_, denominator_;              // without zeros at the end
  std::vector<double> slope_numerator_, slope_denominator_;  // R' = slope_numerator / slope_denominator, in r^2
  double bend_;
  std::vector<Level> levels_;  // ascending radius
  double end_;
  double denominator_share_;  // D is above this times the sum of its terms' magnitudes
};

}  // namespace facemap
