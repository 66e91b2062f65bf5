#pragma once

#include <span>

namespace facemap {

/// How far a polynomial stays positive: a bound r, rounded down, such that c[0] + c[1] x + c[2] x^2 + ... > 0 for all
/// 0 <= x < r; infinity if that holds for all x >= 0. 0 for a polynomial that is not positive at 0, and if a
/// coefficient is not finite. At most 20 coefficients.
///
/// The bound is the least root but for what rounding cannot tell from one: values below 2^-42 times the largest
/// coefficient times (1 + x)^degree.
double positive_range(std::span<const double> coefficients);

}  // namespace facemap
