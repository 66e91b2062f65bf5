#include <facemap/error.h>
#include <facemap/image_file.h>

#include <cmath>

#include "image/srgb.h"
#include "parallel/executor.h"

namespace facemap {
namespace {

constexpr double kLargest16 = 65535;
constexpr std::size_t kLeastPixels = 1 << 12;  ///< for a thread to be worth its start

std::uint16_t level_16(float linear, Transfer transfer) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return static_cast<std::uint16_t>(kLargest16);
  const double light = linear;
  return static_cast<std::uint16_t>(
      std::floor(kLargest16 * (transfer == Transfer::Srgb ? srgb_from_linear(light) : light) + 0.5));
}

void fill_levels(std::span<const Color> colors, Transfer transfer, std::uint16_t* levels) {
  for (std::size_t i = 0; i < colors.size(); ++i, levels += 3) {
    if (i > 0 && colors[i] == colors[i - 1]) {  // often
      for (int k = 0; k < 3; ++k) levels[k] = levels[k - 3];
      continue;
    }
    levels[0] = level_16(colors[i].r, transfer);
    levels[1] = level_16(colors[i].g, transfer);
    levels[2] = level_16(colors[i].b, transfer);
  }
}

}  // namespace

void encode_linear(const Color* colors, std::size_t count, std::uint8_t* bytes) {
  const auto level = [](float light) {
    if (!(light > 0)) return std::uint8_t{0};
    return light >= 1 ? std::uint8_t{255} : static_cast<std::uint8_t>(std::floor(255.0 * light + 0.5));
  };
  for (std::size_t i = 0; i < count; ++i, bytes += 3) {
    bytes[0] = level(colors[i].r);
    bytes[1] = level(colors[i].g);
    bytes[2] = level(colors[i].b);
  }
}

std::vector<std::uint8_t> levels_8(const Image& image, Transfer transfer) {
  std::vector<std::uint8_t> levels(3 * image.pixels.size());
  const auto encode = transfer == Transfer::Srgb ? encode_srgb : encode_linear;
  encode(image.pixels.data(), image.pixels.size(), levels.data());
  return levels;
}

std::vector<std::uint16_t> levels_16(const Image& image, Transfer transfer, int threads) {
  std::vector<std::uint16_t> levels(3 * image.pixels.size());
  const std::span<const Color> colors(image.pixels);
  for_ranges(Executor(threads), colors.size(), kLeastPixels, [&](std::size_t first, std::size_t last, int) {
    fill_levels(colors.subspan(first, last - first), transfer, levels.data() + 3 * first);
  });
  return levels;
}

}  // namespace facemap
