#include "scene/scene_numbers.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "math/elementary.h"

namespace facemap {

namespace {

constexpr double kRadiansOfDegree = elementary::kPi / 180;

template <typename Number>
std::string shortest(Number value) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, error == std::errc() ? end : buffer);
}

std::string text_of_digits(double value, int digits) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  return std::string(buffer, error == std::errc() ? end : buffer);
}

double parse(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::string shortest_text(double value) { return shortest(value); }
std::string shortest_text(float value) { return shortest(value); }

std::optional<float> nearest_float(double value) {
  if (!std::isfinite(value)) return std::nullopt;
  const std::string text = shortest(value);
  float nearest = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), nearest).ec == std::errc()) return nearest;
  // Out of range: too large, or next to nothing.
  if (std::fabs(value) > 1) return std::nullopt;
  return static_cast<float>(value);
}

std::optional<Vector> axis_of(std::string_view name) {
  const bool has_sign = name.size() == 2 && (name[0] == '-' || name[0] == '+');
  const float length = name.size() == 2 && name[0] == '-' ? -1.0f : 1.0f;
  if (has_sign) name.remove_prefix(1);
  if (name == "x") return Vector(length, 0, 0);
  if (name == "y") return Vector(0, length, 0);
  if (name == "z") return Vector(0, 0, length);
  return std::nullopt;
}

double radians_of(double degrees) { return degrees * kRadiansOfDegree; }

std::string degrees_of(double radians) {
  constexpr int kFewestDigits = 13, kMostDigits = 17;
  const double degrees = radians * (180 / elementary::kPi);
  for (int digits = kFewestDigits; digits < kMostDigits; ++digits) {
    const std::string text = text_of_digits(degrees, digits);
    if (radians_of(parse(text)) == radians) return text;
  }
  constexpr int kSteps = 4;  // of a unit in the last place: what two multiplications may lose
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double near = std::bit_cast<double>(std::bit_cast<std::int64_t>(degrees) + step);
    if (radians_of(near) == radians) return shortest(near);
  }
  return text_of_digits(degrees, kMostDigits);
}

}  // namespace facemap
