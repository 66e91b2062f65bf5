#pragma once

#include <cstdint>

namespace facemap {

/// Linear RGB; 1 is white. Wang 2022, sec. 4.3: the Color class.
struct Color {
  float r = 0, g = 0, b = 0;

  friend Color operator+(Color x, Color y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
  friend Color operator-(Color x, Color y) { return {x.r - y.r, x.g - y.g, x.b - y.b}; }
  friend Color operator*(Color x, float s) { return {x.r * s, x.g * s, x.b * s}; }
  friend Color operator*(Color x, Color y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
  friend bool operator==(const Color&, const Color&) = default;

  /// 0xRRGGBB: sRGB transfer (IEC 61966-2-1), clamped to 0..1, rounded to nearest. NaN is 0.
  std::uint32_t to_24_bit() const;

  /// The linear colour of 0xRRGGBB; to_24_bit() gives it back.
  static Color from_24_bit(std::uint32_t rgb);
};

}  // namespace facemap
