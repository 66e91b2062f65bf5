#pragma once

#include <facemap/vector.h>
#include <gmpxx.h>

#include <cmath>
#include <limits>

/// The referee's exact numbers: GMP integers in units of 2^-149, of which every float32 is a multiple.
namespace oracle {

using facemap::Vector;

struct BigVector {
  mpz_class x, y, z;
};

inline mpz_class big(float value) { return mpz_class(std::ldexp(static_cast<double>(value), 149)); }
inline BigVector big(const Vector& v) { return {big(v.x), big(v.y), big(v.z)}; }

inline BigVector operator+(const BigVector& a, const BigVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline BigVector operator-(const BigVector& a, const BigVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline BigVector operator*(const mpz_class& s, const BigVector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline mpz_class dot(const BigVector& a, const BigVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline BigVector cross(const BigVector& a, const BigVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// x / w in world units. mpz_get_d_2exp truncates to 53 bits: 2^-52 relative each, and one rounding.
inline double rounded_quotient(const mpz_class& x, const mpz_class& w) {
  if (x == 0) return 0;
  long x_exponent = 0, w_exponent = 0;
  const double m = mpz_get_d_2exp(&x_exponent, x.get_mpz_t()) / mpz_get_d_2exp(&w_exponent, w.get_mpz_t());
  const long exponent = x_exponent - w_exponent - 149;
  constexpr long kSafe = 200;  // degree 3 with floats (2^-149 to 2^128) stays far inside the range of doubles
  if (exponent < -kSafe || exponent > kSafe) return kUnknown;
  return std::ldexp(m, static_cast<int>(exponent));
}

}  // namespace oracle
