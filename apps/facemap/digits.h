#pragma once

#include <facemap/image.h>

#include <string>

namespace facemap::program {

/// A bitmap font of the ten digits, 5 x 7 dots each, one dot between them.
inline constexpr int kDigitWidth = 5;
inline constexpr int kDigitHeight = 7;

/// Width of a number in pixels at `scale` pixels a dot.
int digits_width(const std::string& digits, int scale);

/// Draws digits with their upper left corner at (x, y); what lies outside the image is left out.
void draw_digits(Image& image, const std::string& digits, int x, int y, int scale, const Color& color);

/// Fills a rectangle; what lies outside the image is left out.
void fill_rectangle(Image& image, int x, int y, int width, int height, const Color& color);

}  // namespace facemap::program
