#include "hit_picture.h"

#include <facemap/hit_color.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <string>

#include "digits.h"

namespace facemap::program {
namespace {

constexpr int kSwatches = 9;
constexpr int kDotsHigh = 2 * kDigitHeight + 8;  // of the legend: a swatch, a number, space around them

const Color kPaper = Color::from_24_bit(0xffffff);
const Color kInk = Color::from_24_bit(0x000000);

/// Up to kSwatches different numbers from 0 to `most`, dense where they are small.
std::vector<int> legend_numbers(int most) {
  std::vector<int> numbers{0};
  for (int i = 1; i < kSwatches; ++i) {
    const double share = static_cast<double>(i) / (kSwatches - 1);
    const int number = static_cast<int>(std::lround(most * share * share));
    if (number > numbers.back()) numbers.push_back(number);
  }
  return numbers;
}

void count_row(const Camera& map, int y, int* hits) {
  for (int x = 0; x < map.width(); ++x) {
    const Vector direction = map.direction_through({x + 0.5, y + 0.5});
    hits[x] = direction == Vector(0) ? kNoDirection : map.count_hits(direction);
  }
}

void draw_legend(Image& image, int top, int scale, int most) {
  const std::vector<int> numbers = legend_numbers(most);
  const int step = image.width / static_cast<int>(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const int x = static_cast<int>(i) * step;
    const int y = top + 2 * scale, height = kDigitHeight * scale;
    fill_rectangle(image, x + scale, y, step - 2 * scale, height, kInk);
    fill_rectangle(image, x + 2 * scale, y + scale, step - 4 * scale, height - 2 * scale, hit_color(numbers[i], most));
    const std::string digits = std::to_string(numbers[i]);
    draw_digits(image, digits, x + (step - digits_width(digits, scale)) / 2, y + height + 3 * scale, scale, kInk);
  }
}

}  // namespace

std::vector<int> count_hits_by_texel(const Camera& map, int threads) {
  const auto width = static_cast<std::size_t>(map.width());
  std::vector<int> hits(width * static_cast<std::size_t>(map.height()));
  std::atomic<int> next_row = 0;
  const auto count_rows = [&] {
    for (int y = 0; (y = next_row++) < map.height();) count_row(map, y, &hits[static_cast<std::size_t>(y) * width]);
  };
  std::vector<std::future<void>> others;
  for (int i = 1; i < threads; ++i) others.push_back(std::async(std::launch::async, count_rows));
  count_rows();
  for (std::future<void>& other : others) other.get();
  return hits;
}

Image hit_picture(const std::vector<int>& hits, int width, int height) {
  const int scale = std::max(1, width / 320);
  const int most = std::max(1, *std::max_element(hits.begin(), hits.end()));
  Image image;
  image.width = width;
  image.height = height + kDotsHigh * scale;
  image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(image.height), kPaper);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    image.pixels[i] = hits[i] == kNoDirection ? no_direction_color() : hit_color(hits[i], most);
  }
  draw_legend(image, height, scale, most);
  return image;
}

}  // namespace facemap::program
