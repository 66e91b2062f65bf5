#include <facemap/error.h>
#include <facemap/image.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "image/filmic.h"
#include "math/elementary.h"
#include "parallel/executor.h"

namespace facemap {
namespace {

constexpr double kMostStops = 64;
constexpr std::size_t kLeastPixels = 1 << 14;  ///< for a thread to be worth its start

// 2^stops; whole stops are exact.
double factor_of(double stops) {
  constexpr double kLn2 = 0.69314718055994531;
  const double whole = std::floor(stops);
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023);
  return std::bit_cast<double>(exponent << 52) * elementary::exp((stops - whole) * kLn2);
}

}  // namespace

double filmic(double light) {
  if (!(light > 0)) return 0;
  // Beyond this the quotient is 1 already, and its terms might overflow.
  if (light > 1e6) return 1;
  const double shown = light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14);
  return shown < 1 ? shown : 1;
}

Image displayed(const Image& image, const DisplayTransform& display, int threads) {
  if (!(std::fabs(display.exposure) <= kMostStops)) throw Error("exposure must be -64 to 64 stops");
  const double factor = factor_of(display.exposure);
  const auto shown = [&](float light) {
    const double exposed = light * factor;
    return static_cast<float>(display.curve == DisplayTransform::Curve::Filmic ? filmic(exposed) : exposed);
  };
  Image result;
  result.width = image.width;
  result.height = image.height;
  result.pixels.resize(image.pixels.size());
  for_ranges(Executor(threads), image.pixels.size(), kLeastPixels, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) {
      const Color& color = image.pixels[i];
      result.pixels[i] = {shown(color.r), shown(color.g), shown(color.b)};
    }
  });
  return result;
}

}  // namespace facemap
