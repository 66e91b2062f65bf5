#pragma once

#include <bit>
#include <cstdint>

namespace facemap {

/// Scanning of numbers in text. The text must end in a byte that stands in no number (a line's '\n'), so that
/// no scanner needs to ask where the end is.

inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

/// A blank inside a line. A carriage return is one, so that CRLF needs no care anywhere else.
inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

inline bool ends_token(char c) { return is_blank(c) || c == '\n'; }

inline const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

inline const char* skip_token(const char* at) {
  while (!ends_token(*at)) ++at;
  return at;
}

/// digits * 10^exponent, a decimal number as written (without its sign).
struct Decimal {
  std::uint64_t digits = 0;
  std::int64_t exponent = 0;
};

inline constexpr int kMaxExactDigits = 19;  ///< any number of so many digits fits 64 bits
inline constexpr int kMaxExactPower = 22;   ///< 10^22 = 2^22 5^22, and 5^22 < 2^53: exact in double
inline constexpr double kPowersOfTen[kMaxExactPower + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The float nearest to a decimal number (ties to even) if a double shows it; false if it does not.
/// Digits up to 2^53 and the power of ten are exact doubles (Clinger 1990), so their quotient or product x is
/// rounded once, and lies between 1e-22 and 1e38: normal as a float, too. Rounding is monotone and the points
/// half-way between floats are doubles: so unless x is such a point (last 29 bits 100...0), x and the true value
/// lie on the same side of each of them, and rounding x to float rounds the true value.
inline bool nearest_float(const Decimal& decimal, float& value) {
  if (decimal.digits > std::uint64_t{1} << 53) return false;
  if (decimal.exponent < -kMaxExactPower || decimal.exponent > kMaxExactPower) return false;
  double x = static_cast<double>(decimal.digits);
  if (decimal.exponent < 0) {
    x /= kPowersOfTen[-decimal.exponent];
  } else {
    x *= kPowersOfTen[decimal.exponent];
  }
  constexpr std::uint64_t kBelowFloat = (std::uint64_t{1} << 29) - 1;
  if ((std::bit_cast<std::uint64_t>(x) & kBelowFloat) == std::uint64_t{1} << 28) return false;
  value = static_cast<float>(x);
  return true;
}

/// scan_float for all numbers: with an exponent, with many digits, near a point half-way between two floats.
const char* scan_any_float(const char* at, float& value);

/// Reads a decimal number as the nearest float (ties to even) and returns its end; nullptr if there is none, if
/// it is followed by anything but a blank or the end of the line, or if it is too large for a float. Digits with
/// or without a point, an exponent and a sign are taken; "nan", "inf" and hexadecimal are not. What is too small
/// becomes zero of its sign.
inline const char* scan_float(const char* const start, float& value) {
  const char* at = start;
  const bool negative = *at == '-';
  if (negative || *at == '+') ++at;

  Decimal decimal;
  const char* const first = at;
  while (is_digit(*at)) decimal.digits = 10 * decimal.digits + static_cast<std::uint64_t>(*at++ - '0');
  std::int64_t count = at - first;
  if (*at == '.') {
    const char* const fraction = ++at;
    while (is_digit(*at)) decimal.digits = 10 * decimal.digits + static_cast<std::uint64_t>(*at++ - '0');
    count += at - fraction;
    decimal.exponent = fraction - at;
  }
  if (count == 0 || count > kMaxExactDigits || !ends_token(*at) || !nearest_float(decimal, value)) {
    return scan_any_float(start, value);
  }
  if (negative) value = -value;
  return at;
}

/// Reads a whole number, which may have a sign, and returns its end (any byte may follow); nullptr if there is
/// none. Numbers of more than 18 digits become +-kHugeIndex.
inline constexpr std::int64_t kHugeIndex = INT64_MAX;
inline const char* scan_index(const char* at, std::int64_t& index) {
  const bool negative = *at == '-';
  if (negative || *at == '+') ++at;
  const char* const first = at;
  std::uint64_t digits = 0;
  while (is_digit(*at)) digits = 10 * digits + static_cast<std::uint64_t>(*at++ - '0');
  if (at == first) return nullptr;
  index = at - first > 18 ? kHugeIndex : static_cast<std::int64_t>(digits);
  if (negative) index = -index;
  return at;
}

}  // namespace facemap
