#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace facemap {

/// Scanning of numbers in text. The text must end in a byte that stands in no number (a line's '\n'), so that
/// no scanner needs to ask where the end is, and so many bytes more must be readable.
inline constexpr int kReadableBeyondEnd = 7;

inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

/// A blank inside a line. A carriage return is one, so that CRLF needs no care anywhere else.
inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

inline bool ends_token(char c) { return is_blank(c) || c == '\n'; }

inline constexpr std::uint32_t kPowersOfTenBelow9[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

/// Reads the digits at `at`, 8 at most, all at once: where numbers differ in length, a loop's end is foretold wrongly
/// time and again. Returns how many there are; `value` is what they say.
inline int scan_8_digits(const char* at, std::uint32_t& value) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::uint64_t kEachByte = 0x0101010101010101;
  std::uint64_t bytes;
  std::memcpy(&bytes, at, sizeof bytes);
  bytes ^= '0' * kEachByte;
  // The top bit of the first byte above 9; a carry out of it goes to later ones alone.
  const std::uint64_t no_digit = ((bytes + (0x80 - 10) * kEachByte) | bytes) & (0x80 * kEachByte);
  if ((no_digit & 0x80) != 0) {
    value = 0;
    return 0;
  }
  const int bits = no_digit == 0 ? 64 : std::countr_zero(no_digit) & ~7;
  bytes <<= 64 - bits;  // as if zeros led
  bytes = (bytes * (10 * 0x100 + 1) >> 8) & 0x00ff00ff00ff00ff;
  bytes = (bytes * (100 * 0x10000 + 1) >> 16) & 0x0000ffff0000ffff;
  value = static_cast<std::uint32_t>(bytes * (10000 * 0x100000000 + 1) >> 32);
  return bits / 8;
}

/// Appends those digits to a number's and returns their end.
inline const char* append_8_digits(const char* at, std::uint64_t& digits) {
  std::uint32_t value;
  const int count = scan_8_digits(at, value);
  digits = digits * kPowersOfTenBelow9[count] + value;
  return at + count;
}

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
/// The power of ten is an exact double (Clinger 1990); the digits are rounded to one if they are above 2^53, and
/// their quotient or product x is rounded once more: 1.5 units of the last place of x at most. x is 0 or between
/// 1e-22 and 1e38: normal as a float, too. The points half-way between floats are doubles whose last 29 bits are
/// 100...0: so unless x is within 2 units of such a point, x and the true value lie on the same side of each of them,
/// and rounding x to float rounds the true value.
inline bool nearest_float(const Decimal& decimal, float& value) {
  if (decimal.digits >> 63 != 0) return false;  // a double is made of a signed integer more quickly
  constexpr int kMaxPower = 19;                 // 2^63 10^19 is below the largest float
  if (decimal.exponent < -kMaxExactPower || decimal.exponent > kMaxPower) return false;
  double x = static_cast<double>(static_cast<std::int64_t>(decimal.digits));
  if (decimal.exponent < 0) {
    x /= kPowersOfTen[-decimal.exponent];
  } else {
    x *= kPowersOfTen[decimal.exponent];
  }
  constexpr std::uint64_t kBelowFloat = (std::uint64_t{1} << 29) - 1, kHalf = std::uint64_t{1} << 28, kDoubt = 2;
  const std::uint64_t above = (std::bit_cast<std::uint64_t>(x) & kBelowFloat) - (kHalf - kDoubt);
  if (above <= 2 * kDoubt) return false;
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
  at += negative | (*at == '+');

  Decimal decimal;
  const char* const first = at;
  while (is_digit(*at)) decimal.digits = 10 * decimal.digits + static_cast<std::uint64_t>(*at++ - '0');
  std::int64_t count = at - first;
  if (*at == '.') {
    const char* const fraction = ++at;
    at = append_8_digits(at, decimal.digits);
    if (at - fraction == 8) at = append_8_digits(at, decimal.digits);
    while (is_digit(*at)) decimal.digits = 10 * decimal.digits + static_cast<std::uint64_t>(*at++ - '0');
    count += at - fraction;
    decimal.exponent = fraction - at;
  }
  if (count == 0 || count > kMaxExactDigits || !ends_token(*at) || !nearest_float(decimal, value)) {
    return scan_any_float(start, value);
  }
  value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ static_cast<std::uint32_t>(negative) << 31);
  return at;
}

/// Whether a word spells infinity or NaN as printf of some system does: "-inf", "nan", "-nan(ind)", "1.#QNAN".
bool spells_not_finite(std::string_view word);

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
