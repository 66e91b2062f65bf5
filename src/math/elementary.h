#pragma once

namespace facemap::elementary {

/// Our own elementary functions: only +, -, *, / and sqrt on doubles in a fixed order, so that every machine
/// and compiler gets the same bits. libm differs between systems. Errors are absolute unless said otherwise
/// and are checked in tests/unit/elementary_test.cpp.

inline constexpr double kPi = 0x1.921fb54442d18p+1;

/// Largest absolute error of sin, cos (|x| <= 2^20), atan2, asin and acos, in radians. A reduction of three
/// parts and one rounded polynomial leave less than 4 units in the last place of values up to pi.
inline constexpr double kAngleError = 0x1p-49;

/// |x| <= 2^20; NaN beyond.
double sin(double x);
double cos(double x);

/// sin(x) / cos(x).
double tan(double x);

/// The angle of (x, y) from +x, in (-pi, pi]; atan2(0, 0) = 0. NaN if either is NaN or both are infinite.
double atan2(double y, double x);

/// x in [-1, 1], clamped to it.
double asin(double x);
double acos(double x);

/// Relative error below 2^-50; 0 at and below -708, infinity above 709.
double exp(double x);

/// Natural logarithm of a positive, finite, normal x; relative error below 2^-50 (absolute near 1).
double log(double x);

/// exp(y log(x)) for x > 0; 0 for x = 0 and y > 0. Relative error below 2^-46 for |y log x| <= 16.
double pow(double x, double y);

}  // namespace facemap::elementary
