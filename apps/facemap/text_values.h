#pragma once

#include <facemap/color.h>
#include <facemap/renderer.h>
#include <facemap/vector.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace facemap::program {

/// Values of options from text and back. The locale plays no part; nan, inf and trailing text are refused.
/// The parsers throw UsageError that says what was expected.

float parse_number(const std::string& text);
float parse_at_least_0(const std::string& text);
float parse_above_0(const std::string& text);
int parse_whole_number(const std::string& text, int least, int most);

/// Stops, -64 to 64, and the width of a filter in pixels, above 0 to 16.
double parse_exposure(const std::string& text);
double parse_filter_width(const std::string& text);

/// Bytes: "1048576", "512M", "2G" (K, M, G and T are powers of 1024).
std::size_t parse_memory(const std::string& text);

/// How many threads, 0 to 1024.
int parse_threads(const std::string& text);

/// Degrees, as radians.
double parse_degrees(const std::string& text);

/// Numbers with commas between them, at least one.
std::vector<double> parse_numbers(const std::string& text);

/// "x,y,z".
Vector parse_vector(const std::string& text);

/// "x", "-y", "z" and the like, or "x,y,z".
Vector parse_direction(const std::string& text);

/// "r,g,b", linear, or "#rrggbb", sRGB.
Color parse_color(const std::string& text);

/// Two colours, one after the other.
std::pair<Color, Color> parse_two_colors(const std::string& text);

/// "WxH", pixels. Refuses more than kMaxPixels, or another limit.
struct Size {
  int width = 1024;
  int height = 1024;
};
inline constexpr long long kMaxPixels = 1LL << 28;  ///< 16384 x 16384: pixels and maps of about 10 GB
Size parse_size(const std::string& text);
Size parse_size_within(const std::string& text, long long max_pixels);

/// "4x4" or "4*4": a grid; "1": one sample; "edges": one sample, 4x4 at edges; "edges:N": N x N at edges.
struct Samples {
  Renderer::Sampling sampling = Renderer::Sampling::Grid;
  int side = 1;
};
Samples parse_samples(const std::string& text);

/// The index of `text` among `choices`.
int parse_choice(const std::string& text, const std::vector<std::string>& choices);

/// The shortest text that reads back as the same float32.
std::string text_of(float value);
std::string text_of(double value);
std::string text_of(const Vector& vector);
std::string text_of(const Color& color);

/// Degrees, shortest text of a double.
std::string degrees_text(double radians);

}  // namespace facemap::program
