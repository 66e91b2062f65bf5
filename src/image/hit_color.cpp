#include <facemap/hit_color.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace facemap {

Color hit_color(int hits, int most) {
  if (hits <= 0) return Color::from_24_bit(0xffffff);
  constexpr double kLightest = 235;  // below white, so that one face among thousands shows
  const double share = std::min(1.0, std::sqrt(static_cast<double>(hits) / std::max(1, most)));
  const auto level = static_cast<std::uint32_t>(std::floor(kLightest * (1 - share) + 0.5));
  return Color::from_24_bit(level << 16 | level << 8 | level);
}

Color no_direction_color() { return Color::from_24_bit(0xbcd0e0); }

}  // namespace facemap
