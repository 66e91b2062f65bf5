#pragma once

#include <cmath>

namespace facemap {

/// A double that carries a bound of its own error: |value - true| <= error (1 + kInflation).
///
/// Running error analysis (Wilkinson 1963, ch. 1.26): each operation adds its rounding, half a unit in the last
/// place of the result, to the errors it inherits. The bounds are themselves rounded, each operation losing at
/// most 4 roundings (2^-51); expressions here have depth below 2^6, so one factor 1 + 2^-40 at the end covers them.
struct Tracked {
  static constexpr double kHalfUlp = 0x1p-53;
  static constexpr double kInflation = 0x1p-40;
  /// More than a product can lose by underflow, flush-to-zero included.
  static constexpr double kUnderflow = 0x1p-1000;

  double value = 0;
  double error = 0;

  static Tracked exact(double value) { return {value, 0}; }

  /// a - b for two floats; exact in most cases, and known to be.
  static Tracked difference(float a, float b) {
    const double x = a, y = b, d = x - y;
    const double y_seen = x - d, x_seen = d + y_seen;  // Knuth's two-sum: the part that was rounded away
    const double lost = (x - x_seen) + (y_seen - y);
    return {d, lost == 0 ? 0 : std::fabs(d) * kHalfUlp};
  }

  /// -1, 0 or 1 if the sign of the true number is known, kUnknown if not. NaN is unknown.
  static constexpr int kUnknown = 2;
  int sign() const {
    const double bound = error * (1 + kInflation);
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return value == 0 && error == 0 ? 0 : kUnknown;
  }
};

inline Tracked operator+(const Tracked& a, const Tracked& b) {
  const double v = a.value + b.value;
  return {v, a.error + b.error + std::fabs(v) * Tracked::kHalfUlp};
}

inline Tracked operator-(const Tracked& a, const Tracked& b) {
  const double v = a.value - b.value;
  return {v, a.error + b.error + std::fabs(v) * Tracked::kHalfUlp};
}

inline Tracked operator-(const Tracked& a) { return {-a.value, a.error}; }

inline Tracked operator*(const Tracked& a, const Tracked& b) {
  // An exact zero stays exact: axis-parallel geometry meets it all the time.
  if ((a.value == 0 && a.error == 0) || (b.value == 0 && b.error == 0)) return {};
  const double v = a.value * b.value;
  return {v, std::fabs(a.value) * b.error + std::fabs(b.value) * a.error + a.error * b.error +
                 std::fabs(v) * Tracked::kHalfUlp + Tracked::kUnderflow};
}

/// a / b. The error is infinite where b may be 0.
inline Tracked quotient(const Tracked& a, const Tracked& b) {
  const double v = a.value / b.value;
  // |v - true| <= (|a's error| + |v| |b's error|) / (|b| - |b's error|), and one rounding.
  const double slack = std::fabs(b.value) - b.error;
  if (!(slack > 0)) return {v, HUGE_VAL};
  return {v, (a.error + std::fabs(v) * b.error) / slack * (1 + Tracked::kInflation) + std::fabs(v) * Tracked::kHalfUlp +
                 Tracked::kUnderflow};
}

}  // namespace facemap
