#include <facemap/color.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "image/srgb.h"
#include "math/elementary.h"

namespace facemap {
namespace {

constexpr int kLevels = 256;
constexpr int kBins = 4096;

/// The smallest float that is not below `value`.
float float_at_or_above(double value) {
  const float nearest = static_cast<float>(value);
  if (nearest >= value) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);  // positive: the next larger one
}

/// Rounding to the nearest level means counting the half-way points at or below a value. In linear light they
/// are at least 1 / (255 * 12.92) = 1.24 bins apart, so a bin holds one at most, and one comparison decides.
class LevelTable {
 public:
  LevelTable() {
    for (int level = 1; level < kLevels; ++level)
      half_way_[level] = float_at_or_above(linear_from_srgb((level - 0.5) / 255));
    half_way_[kLevels] = std::numeric_limits<float>::infinity();
    int level = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      while (half_way_[level + 1] <= static_cast<float>(bin) / kBins) ++level;
      at_bin_start_[bin] = static_cast<std::uint8_t>(level);
    }
  }

  std::uint32_t level(float linear) const {
    // Without branches: what a pixel holds is hard to foresee. NaN is 0.
    const float positive = linear > 0 ? linear : 0, inside = positive < kLast ? positive : kLast;
    const std::uint32_t below = at_bin_start_[static_cast<int>(inside * kBins)];
    return below + (inside >= half_way_[below + 1]);
  }

 private:
  static constexpr float kLast = 1 - 0x1p-24f;  ///< the float before 1

  std::array<float, kLevels + 1> half_way_{};  ///< [k]: where level k begins, linear; [0] is not used
  std::array<std::uint8_t, kBins> at_bin_start_{};
};

const LevelTable& level_table() {
  static const LevelTable table;
  return table;
}

}  // namespace

std::uint32_t Color::to_24_bit() const {
  return level_table().level(r) << 16 | level_table().level(g) << 8 | level_table().level(b);
}

namespace {

/// Colours from `first` to `end` of an array, whose bytes begin at `bytes`.
void encode(const Color* colors, std::size_t first, std::size_t end, std::uint8_t* bytes) {
  const LevelTable& table = level_table();
  std::uint8_t* at = bytes + 3 * first;
  for (std::size_t i = first; i < end; ++i) {
    const Color& color = colors[i];
    if (i > 0 && color == colors[i - 1]) {  // often
      for (int k = 0; k < 3; ++k, ++at) *at = at[-3];
      continue;
    }
    for (const float channel : {color.r, color.g, color.b}) *at++ = static_cast<std::uint8_t>(table.level(channel));
  }
}

}  // namespace

void encode_srgb(const Color* colors, std::size_t count, std::uint8_t* bytes) {
  constexpr std::size_t kRun = 16;  // pixels: background goes on for longer
  for (std::size_t first = 0; first < count; first += kRun) {
    const std::size_t end = std::min(count, first + kRun);
    const bool repeats = first > 0 && end - first == kRun &&
                         std::memcmp(colors + first, colors + first - kRun, kRun * sizeof(Color)) == 0;
    if (repeats) {
      std::memcpy(bytes + 3 * first, bytes + 3 * (first - kRun), 3 * kRun);
    } else {
      encode(colors, first, end, bytes);
    }
  }
}

double linear_from_srgb(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  return elementary::pow((encoded + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double linear) {
  if (linear <= 0.0031308) return 12.92 * linear;
  return 1.055 * elementary::pow(linear, 1 / 2.4) - 0.055;
}

Color Color::from_24_bit(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) { return static_cast<float>(linear_from_srgb((rgb >> shift & 255) / 255.0)); };
  return {channel(16), channel(8), channel(0)};
}

}  // namespace facemap
