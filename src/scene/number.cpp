#include "scene/number.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace facemap {

namespace {

/// Exponents as written beyond this are as good as infinite, even after a million leading zeros.
constexpr int kMaxWrittenExponent = 1'000'000'000;

/// Reads what follows 'e'. Returns its end, nullptr if there are no digits.
const char* scan_exponent(const char* at, int& exponent) {
  const bool negative = *at == '-';
  if (negative || *at == '+') ++at;
  const char* const first = at;
  std::int64_t digits = 0;
  while (is_digit(*at)) digits = std::min<std::int64_t>(10 * digits + (*at++ - '0'), kMaxWrittenExponent);
  if (at == first) return nullptr;
  exponent = static_cast<int>(negative ? -digits : digits);
  return at;
}

/// The digits of a number, with or without a point, all of them counted.
struct Digits {
  Decimal decimal;             ///< if they are few enough
  std::int64_t count = 0;      ///< leading zeros included
  std::int64_t magnitude = 0;  ///< the number without its exponent is below 10^magnitude; far below 0 if it is 0
};

const char* scan_digits(const char* at, Digits& number) {
  std::int64_t before_point = 0, leading_zeros = 0;
  bool seen_point = false, seen_nonzero = false;
  for (; is_digit(*at) || (*at == '.' && !seen_point); ++at) {
    if (*at == '.') {
      seen_point = true;
      before_point = number.count;
      continue;
    }
    seen_nonzero |= *at != '0';
    leading_zeros += !seen_nonzero;
    ++number.count;
    number.decimal.digits = 10 * number.decimal.digits + static_cast<std::uint64_t>(*at - '0');
    number.decimal.exponent -= seen_point;
  }
  if (!seen_point) before_point = number.count;
  number.magnitude = before_point - leading_zeros;
  return at;
}

}  // namespace

const char* scan_any_float(const char* const start, float& value) {
  const bool negative = *start == '-';
  const char* const unsigned_start = start + (negative || *start == '+');

  Digits number;
  const char* at = scan_digits(unsigned_start, number);
  if (number.count == 0) return nullptr;
  int exponent = 0;
  if (*at == 'e' || *at == 'E') {
    at = scan_exponent(at + 1, exponent);
    if (at == nullptr) return nullptr;
  }
  if (!ends_token(*at)) return nullptr;

  number.decimal.exponent += exponent;
  if (number.count > kMaxExactDigits || !nearest_float(number.decimal, value)) {
    const auto result = std::from_chars(unsigned_start, at, value);
    if (result.ec == std::errc::result_out_of_range) {
      // from_chars does not tell overflow from underflow; no float lies near 1, where they would meet.
      if (number.magnitude + exponent > 0) return nullptr;
      value = 0;
    } else if (result.ec != std::errc() || result.ptr != at) {
      return nullptr;
    }
  }
  if (negative) value = -value;
  return at;
}

bool spells_not_finite(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  if (word.starts_with("1.#")) return true;
  const auto begins_with = [word](std::string_view lower) {
    return word.size() >= lower.size() &&
           std::equal(lower.begin(), lower.end(), word.begin(), [](char l, char c) { return l == c || l - c == 0x20; });
  };
  return begins_with("nan") || begins_with("inf");
}

}  // namespace facemap
