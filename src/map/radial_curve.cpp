#include "map/radial_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "math/positive_range.h"
#include "math/rising_root.h"

namespace facemap {
namespace {

// Polynomials in s = r^2, ascending.
using Polynomial = std::vector<double>;

double evaluate(std::span<const double> p, double s) {
  double sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * s + p[i];
  return sum;
}

double evaluate_magnitudes(std::span<const double> p, double s) {
  double sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * s + std::fabs(p[i]);
  return sum;
}

Polynomial product(std::span<const double> a, std::span<const double> b) {
  Polynomial c(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) c[i + k] += a[i] * b[k];
  }
  return c;
}

// s p'(s) times two: what r d/dr makes of p(r^2).
Polynomial times_r_derivative(std::span<const double> p) {
  Polynomial q(p.begin(), p.end());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] *= 2.0 * static_cast<double>(i);
  return q;
}

Polynomial without_zeros(std::span<const double> p) {
  while (p.size() > 1 && p.back() == 0) p = p.first(p.size() - 1);
  return {p.begin(), p.end()};
}

// How far a(r^2) - (level + rate r) b(r^2) stays positive.
double range_above(std::span<const double> a, std::span<const double> b, double level, double rate) {
  std::vector<double> in_r(2 * std::max(a.size(), b.size()), 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) in_r[2 * i] = a[i];
  for (std::size_t i = 0; i < b.size(); ++i) {
    in_r[2 * i] -= level * b[i];
    in_r[2 * i + 1] = -rate * b[i];
  }
  return positive_range(in_r);
}

// Levels are four an octave, each a little less than a short fraction so that rounding cannot make it too high.
constexpr double kLevelMargin = 1 - 0x1p-20;

}  // namespace

RadialCurve::RadialCurve(const std::array<double, kMostTerms>& numerator,
                         const std::array<double, kMostTerms>& denominator, double bend, double limit)
    : numerator_(without_zeros(numerator)), denominator_(without_zeros(denominator)), bend_(bend) {
  // R' = ((N + r dN/dr) D - N r dD/dr) / D^2.
  const Polynomial &n = numerator_, &d = denominator_;
  const Polynomial dn = times_r_derivative(n), dd = times_r_derivative(d);
  Polynomial rising(n.begin(), n.end());
  for (std::size_t i = 0; i < n.size(); ++i) rising[i] += dn[i];
  slope_numerator_ = product(rising, d);
  const Polynomial falling = product(n, dd);
  for (std::size_t i = 0; i < falling.size(); ++i) slope_numerator_[i] -= falling[i];
  slope_denominator_ = product(d, d);
  find_levels(limit);
}

// Where g stays above `level`. D is positive there, as the limit sees to.
double RadialCurve::range_above(double level) const {
  return std::min(facemap::range_above(slope_numerator_, slope_denominator_, level, 6 * bend_),
                  facemap::range_above(numerator_, denominator_, level, 6 * bend_));
}

void RadialCurve::find_levels(double limit) {
  Polynomial magnitudes(denominator_.begin(), denominator_.end());
  for (double& term : magnitudes) term = std::fabs(term);
  const auto range_of_denominator = [&](double level) {
    return facemap::range_above(denominator_, magnitudes, level, 0);
  };
  limit = std::min(limit, range_of_denominator(kLeastSlope));
  end_ = 0;
  for (double octave = 1; octave > kLeastSlope && end_ < limit; octave *= 0.5) {
    for (const double part : {1.0, 0.875, 0.75, 0.625}) {
      const double slope = octave * part * kLevelMargin;
      const double radius = std::min(limit, range_above(slope));
      if (radius > end_) levels_.push_back({slope, radius});
      end_ = std::max(end_, radius);
    }
  }
  const double last = kLeastSlope * kLevelMargin;
  const double radius = std::min(limit, range_above(last));
  if (radius > end_ || levels_.empty()) levels_.push_back({last, radius});
  end_ = std::max(end_, radius);

  denominator_share_ = kLeastSlope;
  for (double level = 1; level > kLeastSlope; level *= 0.875) {
    if (range_of_denominator(level * kLevelMargin) < end_) continue;
    denominator_share_ = level * kLevelMargin;
    break;
  }
}

double RadialCurve::factor(double r_squared) const {
  return evaluate(numerator_, r_squared) / evaluate(denominator_, r_squared);
}

double RadialCurve::value(double r) const { return r * factor(r * r); }

double RadialCurve::slope(double r) const {
  return evaluate(slope_numerator_, r * r) / evaluate(slope_denominator_, r * r);
}

// The root of R(r) - pull r^2 = target, which rises in the field for pull <= 3 bend.
double RadialCurve::rising_radius(double target, double pull) const {
  const auto f = [&](double r) { return ValueAndSlope{value(r) - pull * r * r - target, slope(r) - 2 * pull * r}; };
  double high = std::min(end_, std::max(target, 0x1p-60));
  while (high < end_ && f(high).value < 0) high = std::min(end_, 2 * high);
  if (f(high).value < 0) return std::numeric_limits<double>::infinity();
  return rising_root(f, 0, high, target);
}

double RadialCurve::radius(double target) const { return target > 0 ? rising_radius(target, 0) : 0; }

double RadialCurve::outer_radius(double reach) const {
  // |F(a)| >= R(r) - 3 bend r^2. A root is off by its error over the slope: much less than the margin.
  return std::min(end_, rising_radius(reach, 3 * bend_) * (1 + 0x1p-20));
}

double RadialCurve::least_slope(double r) const {
  for (const Level& level : levels_) {
    if (r <= level.radius) return level.slope;
  }
  return levels_.back().slope;
}

// With |N| and |D| the sums of magnitudes and D >= share |D|: shares e of |N| and |D| as errors change r N/D by at most
// e (r |N| + R |D|)/D <= e (r |N|/|D| + R)/share. In rings, as |N| and |D| grow together.
double RadialCurve::magnitude(double r) const {
  constexpr int kRings = 32;
  double most = 0;
  for (int i = 0; i < kRings; ++i) {
    const double inner = r * i / kRings, outer = r * (i + 1) / kRings;
    const double n = evaluate_magnitudes(numerator_, outer * outer);
    most = std::max(most, outer * n / evaluate_magnitudes(denominator_, inner * inner));
  }
  return (most + value(r)) / denominator_share_ + 3 * bend_ * r * r;
}

}  // namespace facemap
