#include "scene/colour_values.h"

#include <algorithm>
#include <vector>

#include "image/srgb.h"

namespace facemap {

namespace {

std::vector<float> linear_table(int last) {
  std::vector<float> table;
  for (int level = 0; level <= last; ++level) {
    table.push_back(static_cast<float>(linear_from_srgb(static_cast<double>(level) / last)));
  }
  return table;
}

float look_up(const std::vector<float>& table, float value, bool& is_inside) {
  const auto last = static_cast<float>(table.size() - 1);
  const bool inside = value >= 0 && value <= last;  // NaN is not
  is_inside = is_inside && inside;
  if (!inside) return value < 0 ? 0.0f : 1.0f;
  return table[static_cast<std::size_t>(value + 0.5f)];
}

}  // namespace

ColourScale colour_scale_of(PlyType type) {
  if (!is_whole(type)) return ColourScale::Linear;
  return type == PlyType::UInt16 ? ColourScale::Srgb16 : ColourScale::Srgb8;
}

float linear_channel(float value, ColourScale scale, bool& is_inside) {
  static const std::vector<float> table_8 = linear_table(255);
  switch (scale) {
    case ColourScale::Linear:
      break;
    case ColourScale::Srgb8:
      return look_up(table_8, value, is_inside);
    case ColourScale::Srgb16: {
      static const std::vector<float> table_16 = linear_table(65535);
      return look_up(table_16, value, is_inside);
    }
  }
  const bool inside = value >= 0 && value <= 1;
  is_inside = is_inside && inside;
  return inside ? value : value < 0 ? 0.0f : 1.0f;
}

}  // namespace facemap
