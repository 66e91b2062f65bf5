#include "text_values.h"

#include <charconv>
#include <cmath>
#include <cstdint>

#include "usage_error.h"

namespace facemap::program {
namespace {

constexpr int kMaxSide = 32768;  // what a Projection takes
constexpr int kMaxSamples = 16;  // what a Renderer takes, a side
constexpr double kPi = 3.14159265358979323846;

[[noreturn]] void refuse(const std::string& text, const std::string& expected) {
  throw UsageError("'" + text + "' is not " + expected);
}

/// The whole text as a number; false if it is something else.
template <typename Number>
bool read(std::string_view text, Number& number) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

bool read_finite(std::string_view text, float& number) {
  if (read(text, number)) return std::isfinite(number);
  // from_chars gives the same error to what is too large and to what is next to nothing.
  double wide = 0;
  if (!read(text, wide) || !(std::fabs(wide) < 1)) return false;
  number = static_cast<float>(wide);
  return true;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Comma-separated numbers; empty if one of them is none.
std::vector<float> read_numbers(const std::string& text) {
  std::vector<float> numbers;
  for (const std::string& part : split(text, ',')) {
    float number = 0;
    if (!read_finite(part, number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

/// Two whole numbers with an x or * between them.
bool read_pair(const std::string& text, int& first, int& second) {
  const std::size_t cross = text.find_first_of("xX*");
  if (cross == std::string::npos) return false;
  const std::string_view view = text;
  return read(view.substr(0, cross), first) && read(view.substr(cross + 1), second);
}

template <typename Number>
std::string shortest(Number value) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, error == std::errc() ? end : buffer);
}

}  // namespace

float parse_number(const std::string& text) {
  float number = 0;
  if (!read_finite(text, number)) refuse(text, "a number");
  return number;
}

float parse_at_least_0(const std::string& text) {
  const float number = parse_number(text);
  if (number < 0) refuse(text, "a number of 0 or more");
  return number;
}

float parse_above_0(const std::string& text) {
  const float number = parse_number(text);
  if (!(number > 0)) refuse(text, "a number above 0");
  return number;
}

int parse_whole_number(const std::string& text, int least, int most) {
  int number = 0;
  if (!read(text, number) || number < least || number > most) {
    refuse(text, "a whole number of " + std::to_string(least) + " to " + std::to_string(most));
  }
  return number;
}

int parse_threads(const std::string& text) {
  constexpr int kMostThreads = 1024;
  return parse_whole_number(text, 0, kMostThreads);
}

std::size_t parse_memory(const std::string& text) {
  constexpr std::string_view kUnits = "KMGT";
  constexpr std::size_t kMost = std::size_t{1} << 50;
  std::string_view digits = text;
  std::size_t unit = 1;
  if (const std::size_t i = digits.empty() ? kUnits.npos : kUnits.find(digits.back()); i != kUnits.npos) {
    unit <<= 10 * (i + 1);
    digits.remove_suffix(1);
  }
  std::size_t count = 0;
  if (digits.starts_with('+') || !read(digits, count) || count < 1 || count > kMost / unit) {
    refuse(text, "an amount of memory such as 512M or 2G");
  }
  return count * unit;
}

double parse_degrees(const std::string& text) {
  double degrees = 0;
  if (!read(text, degrees) || !(degrees > 0) || !(degrees <= 360))
    refuse(text, "an angle of more than 0 to 360 degrees");
  return degrees * (kPi / 180);
}

std::vector<double> parse_numbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, ',')) {
    double number = 0;
    if (!read(part, number) || !std::isfinite(number)) refuse(text, "numbers with commas between them");
    numbers.push_back(number);
  }
  return numbers;
}

double parse_exposure(const std::string& text) {
  double stops = 0;
  if (!read(text, stops) || !(stops >= -64) || !(stops <= 64)) refuse(text, "-64 to 64 stops");
  return stops;
}

double parse_filter_width(const std::string& text) {
  double pixels = 0;
  if (!read(text, pixels) || !(pixels > 0) || !(pixels <= 16)) refuse(text, "a width above 0 to 16 pixels");
  return pixels;
}

Vector parse_vector(const std::string& text) {
  const std::vector<float> numbers = read_numbers(text);
  if (numbers.size() != 3) refuse(text, "three numbers x,y,z");
  return {numbers[0], numbers[1], numbers[2]};
}

Vector parse_direction(const std::string& text) {
  const bool has_sign = text.size() == 2 && (text[0] == '-' || text[0] == '+');
  const float length = text.starts_with('-') ? -1.0f : 1.0f;
  const std::string axis = has_sign ? text.substr(1) : text;
  if (axis == "x") return {length, 0, 0};
  if (axis == "y") return {0, length, 0};
  if (axis == "z") return {0, 0, length};
  const std::vector<float> numbers = read_numbers(text);
  if (numbers.size() != 3) refuse(text, "a direction: x, y, z, -x, -y, -z or three numbers x,y,z");
  const Vector direction(numbers[0], numbers[1], numbers[2]);
  if (direction == Vector(0)) refuse(text, "a direction");
  return direction;
}

Color parse_color(const std::string& text) {
  if (text.starts_with('#')) {
    std::uint32_t rgb = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + 1, end, rgb, 16);
    if (text.size() != 7 || error != std::errc() || stop != end) refuse(text, "a colour #rrggbb");
    return Color::from_24_bit(rgb);
  }
  const std::vector<float> numbers = read_numbers(text);
  if (numbers.size() != 3) refuse(text, "a colour: three linear values r,g,b, or #rrggbb");
  if (numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 0) refuse(text, "a colour: a value is below 0");
  return {numbers[0], numbers[1], numbers[2]};
}

std::pair<Color, Color> parse_two_colors(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  for (std::size_t first = 1; first < parts.size(); ++first) {
    const std::size_t second = parts.size() - first;
    const bool is_first = first == (parts[0].starts_with('#') ? 1 : 3);
    if (!is_first || second != (parts[first].starts_with('#') ? 1u : 3u)) continue;
    std::size_t comma = std::string::npos;
    for (std::size_t i = 0; i < first; ++i) comma = text.find(',', comma + 1);
    return {parse_color(text.substr(0, comma)), parse_color(text.substr(comma + 1))};
  }
  refuse(text, "two colours, each three linear values r,g,b or #rrggbb");
}

Size parse_size(const std::string& text) { return parse_size_within(text, kMaxPixels); }

Size parse_size_within(const std::string& text, long long max_pixels) {
  Size size;
  if (!read_pair(text, size.width, size.height)) refuse(text, "a size in pixels such as 1024x768");
  for (const int side : {size.width, size.height}) {
    if (side < 1 || side > kMaxSide) refuse(text, "a size: each side is 1 to " + std::to_string(kMaxSide) + " pixels");
  }
  if (static_cast<long long>(size.width) * size.height > max_pixels) {
    refuse(text, "a size this program takes: " + std::to_string(max_pixels) + " pixels at most");
  }
  return size;
}

Samples parse_samples(const std::string& text) {
  Samples samples;
  if (text == "1") return samples;
  int second = 4;
  if (text == "edges") {
    samples = {Renderer::Sampling::Edges, second};
  } else if (text.starts_with("edges:") && read(std::string_view(text).substr(6), second)) {
    samples = {Renderer::Sampling::Edges, second};
  } else if (!read_pair(text, samples.side, second)) {
    refuse(text, "1, a grid such as 4x4, or edges");
  }
  if (samples.side != second || second < 1 || second > kMaxSamples) {
    refuse(text, "a square grid of 1x1 to " + std::to_string(kMaxSamples) + "x" + std::to_string(kMaxSamples));
  }
  return samples;
}

int parse_choice(const std::string& text, const std::vector<std::string>& choices) {
  std::string list;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (text == choices[i]) return static_cast<int>(i);
    list += (i ? i + 1 == choices.size() ? " or " : ", " : "") + choices[i];
  }
  refuse(text, list);
}

std::string text_of(float value) { return shortest(value); }
std::string text_of(double value) { return shortest(value); }

std::string text_of(const Vector& vector) {
  return text_of(vector.x) + "," + text_of(vector.y) + "," + text_of(vector.z);
}

std::string text_of(const Color& color) { return text_of(Vector(color.r, color.g, color.b)); }

std::string degrees_text(double radians) {
  // A double carries 15 digits; two fewer hide the rounding of the two conversions.
  char buffer[64];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, radians * (180 / kPi), std::chars_format::general, 13);
  return std::string(buffer, error == std::errc() ? end : buffer);
}

}  // namespace facemap::program
