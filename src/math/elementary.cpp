#include "math/elementary.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

namespace facemap::elementary {
namespace {

// pi/2 = kHalfPi1 + kHalfPi2 + kHalfPi3; the first two have 33 bits, so k * part is exact for |k| < 2^20.
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;

// ln 2 = kLn2High + kLn2Low; the first has 32 bits.
constexpr double kLn2High = 0x1.62e42feep-1;
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;

constexpr double kLargestAngle = 0x1p20;

// Taylor series about 0, |x| <= pi/4: the first term left out is below 2^-63.
double sin_near_zero(double x) {
  const double s = x * x;
  double p = 1.0 / 355687428096000.0;  // 1/17!
  p = p * s - 1.0 / 1307674368000.0;
  p = p * s + 1.0 / 6227020800.0;
  p = p * s - 1.0 / 39916800.0;
  p = p * s + 1.0 / 362880.0;
  p = p * s - 1.0 / 5040.0;
  p = p * s + 1.0 / 120.0;
  p = p * s - 1.0 / 6.0;
  return x + x * s * p;
}

double cos_near_zero(double x) {
  const double s = x * x;
  double p = -1.0 / 6402373705728000.0;  // -1/18!
  p = p * s + 1.0 / 20922789888000.0;
  p = p * s - 1.0 / 87178291200.0;
  p = p * s + 1.0 / 479001600.0;
  p = p * s - 1.0 / 3628800.0;
  p = p * s + 1.0 / 40320.0;
  p = p * s - 1.0 / 720.0;
  p = p * s + 1.0 / 24.0;
  return (1.0 - 0.5 * s) + s * s * p;
}

struct Reduced {
  double remainder;  // in [-pi/4, pi/4] up to rounding
  std::int64_t quadrant;
};

Reduced reduce(double x) {
  const double k = std::nearbyint(x * (2.0 / kPi));
  const double r = ((x - k * kHalfPi1) - k * kHalfPi2) - k * kHalfPi3;
  return {r, static_cast<std::int64_t>(k) & 3};
}

// atan(k/8), k = 0..8.
constexpr double kArcTangents[9] = {0.0,
                                    0x1.fd5ba9aac2f6ep-4,
                                    0x1.f5b75f92c80ddp-3,
                                    0x1.6f61941e4def1p-2,
                                    0x1.dac670561bb4fp-2,
                                    0x1.1e00babdefeb4p-1,
                                    0x1.4978fa3269ee1p-1,
                                    0x1.700a7c5784634p-1,
                                    0x1.921fb54442d18p-1};

// numerator / denominator in [0, 1]: atan(n/d) = atan(c) + atan((n - c d) / (d + c n)) with c = k/8 nearest,
// so the second argument is below 1/16 and the first term of the series left out below 2^-64.
double atan_of_ratio(double numerator, double denominator) {
  const int k = static_cast<int>(numerator / denominator * 8.0 + 0.5);
  const double c = k * 0.125;
  const double t = (numerator - c * denominator) / (denominator + c * numerator);
  const double s = t * t;
  double p = 1.0 / 13.0;
  p = 1.0 / 11.0 - p * s;
  p = 1.0 / 9.0 - p * s;
  p = 1.0 / 7.0 - p * s;
  p = 1.0 / 5.0 - p * s;
  p = 1.0 / 3.0 - p * s;
  return kArcTangents[k] + (t - t * s * p);
}

}  // namespace

double sin(double x) {
  if (!(std::fabs(x) <= kLargestAngle)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced r = reduce(x);
  const double value = (r.quadrant & 1) ? cos_near_zero(r.remainder) : sin_near_zero(r.remainder);
  return (r.quadrant & 2) ? -value : value;
}

double cos(double x) {
  if (!(std::fabs(x) <= kLargestAngle)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced r = reduce(x);
  const double value = (r.quadrant & 1) ? sin_near_zero(r.remainder) : cos_near_zero(r.remainder);
  return (r.quadrant == 1 || r.quadrant == 2) ? -value : value;
}

double tan(double x) { return sin(x) / cos(x); }

double atan2(double y, double x) {
  const double ay = std::fabs(y), ax = std::fabs(x);
  if (ay == 0.0 && ax == 0.0) return 0.0;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool has_angle = (ay <= ax && ay < kInfinity) || (ax < ay && ax < kInfinity);
  if (!has_angle) return std::numeric_limits<double>::quiet_NaN();
  double angle = ay <= ax ? atan_of_ratio(ay, ax) : kPi / 2 - atan_of_ratio(ax, ay);
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

double asin(double x) {
  x = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
  return atan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

double acos(double x) {
  x = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
  return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

double exp(double x) {
  if (!(x > -708.0)) return x != x ? x : 0.0;
  if (x > 709.0) return std::numeric_limits<double>::infinity();
  const double k = std::nearbyint(x * (1.0 / (kLn2High + kLn2Low)));
  const double r = (x - k * kLn2High) - k * kLn2Low;  // |r| <= 0.347: the term of degree 14 is below 2^-57
  double p = 1.0 / 6227020800.0;
  for (double factorial : {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0, 720.0, 120.0, 24.0, 6.0}) {
    p = p * r + 1.0 / factorial;
  }
  p = p * r + 0.5;
  const double value = 1.0 + (r + r * r * p);
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1023);
  return value * std::bit_cast<double>(exponent << 52);
}

double log(double x) {
  constexpr double kSqrtHalf = 0.70710678118654752;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  auto exponent = static_cast<std::int64_t>(bits >> 52) - 1022;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffu) | (std::uint64_t{1022} << 52));  // in [1/2, 1)
  if (m < kSqrtHalf) {
    m = m * 2.0;
    exponent -= 1;
  }
  // log m = 2 atanh(s), |s| <= 0.1716: the term of degree 25 is below 2^-66.
  const double s = (m - 1.0) / (m + 1.0);
  const double q = s * s;
  double p = 1.0 / 23.0;
  for (double degree : {21.0, 19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0}) p = p * q + 1.0 / degree;
  const double k = static_cast<double>(exponent);
  return k * kLn2High + (2.0 * s + (2.0 * s * q * p + k * kLn2Low));
}

double pow(double x, double y) {
  if (x == 0.0) return y > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  return exp(y * log(x));
}

}  // namespace facemap::elementary
