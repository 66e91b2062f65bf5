#include "material/texel_codes.h"

#include <facemap/color.h>

#include <array>
#include <cstddef>

namespace facemap {
namespace {

using Table = std::array<float, 256>;

Table make_table(bool is_srgb) {
  Table table;
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    table[i] = is_srgb ? Color::from_24_bit(i).b : static_cast<float>(i) / 255;
  }
  return table;
}

std::uint8_t byte_of(float value) { return static_cast<std::uint8_t>(value * 255 + 0.5f); }

}  // namespace

const float* linear_values(bool is_srgb) {
  static const Table colours = make_table(true), numbers = make_table(false);
  return is_srgb ? colours.data() : numbers.data();
}

std::vector<std::uint8_t> encoded(const std::vector<float>& values, bool is_srgb) {
  std::vector<std::uint8_t> bytes(values.size());
  for (std::size_t i = 0; i < values.size(); i += 4) {
    if (is_srgb) {
      const std::uint32_t rgb = Color{values[i], values[i + 1], values[i + 2]}.to_24_bit();
      for (std::size_t k = 0; k < 3; ++k) bytes[i + k] = static_cast<std::uint8_t>(rgb >> (16 - 8 * k));
    } else {
      for (std::size_t k = 0; k < 3; ++k) bytes[i + k] = byte_of(values[i + k]);
    }
    bytes[i + 3] = byte_of(values[i + 3]);
  }
  return bytes;
}

}  // namespace facemap
