#include "material/texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "material/half_size.h"
#include "material/texel_codes.h"
#include "scene/texture_wrap.h"

namespace facemap {
namespace {

float mixed(float a, float b, float share) { return a + (b - a) * share; }

TextureValue mixed(const TextureValue& a, const TextureValue& b, float share) {
  return {mixed(a.r, b.r, share), mixed(a.g, b.g, share), mixed(a.b, b.b, share), mixed(a.a, b.a, share)};
}

// The largest power of two that is not above a normal number, as its exponent.
int exponent_of(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1023; }
double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52); }

}  // namespace

Texture::Texture(DecodedImage&& image, Encoding encoding) : encoding_(encoding), linear_(linear_values(is_colour())) {
  levels_.push_back({image.width, image.height, std::move(image.rgba)});
  add_levels();
  if (encoding == Encoding::CutOuts && image.has_alpha) fill_clear_texels();
}

void Texture::add_levels() {
  std::vector<float> values;  // of the last level, linear, not rounded to bytes
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& last = levels_.back();
    Level next{std::max(1, last.width / 2), std::max(1, last.height / 2), {}};
    const bool by_alpha = encoding_ == Encoding::CutOuts;
    values = levels_.size() == 1 ? half_size(ByteTexels{last.rgba.data(), linear_}, last.width, last.height, by_alpha)
                                 : half_size(FloatTexels{values.data()}, last.width, last.height, by_alpha);
    next.rgba = encoded(values, is_colour());
    levels_.push_back(std::move(next));
  }
}

// What is clear has any colour, often black, which would darken the edges of leaves: it takes that of the level above.
void Texture::fill_clear_texels() {
  for (std::size_t i = levels_.size() - 1; i-- > 0;) {
    Level& level = levels_[i];
    const Level& half = levels_[i + 1];
    for (int y = 0; y < level.height; ++y) {
      for (int x = 0; x < level.width; ++x) {
        const auto place = [](const Level& of, int column, int row) {
          return 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(of.width) +
                      static_cast<std::size_t>(column));
        };
        std::uint8_t* const to = &level.rgba[place(level, x, y)];
        if (to[3] != 0) continue;
        const std::size_t from = place(half, std::min(x / 2, half.width - 1), std::min(y / 2, half.height - 1));
        std::copy_n(&half.rgba[from], 3, to);
      }
    }
  }
}

TextureValue Texture::texel(const Level& level, int x, int y) const {
  const std::size_t place =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x);
  const std::uint8_t* const bytes = level.rgba.data() + 4 * place;
  return {linear_[bytes[0]], linear_[bytes[1]], linear_[bytes[2]], static_cast<float>(bytes[3]) * (1 / 255.0f)};
}

TextureValue Texture::nearest(const Level& level, const TexturePoint& place, const TextureUse& use) const {
  const int x = static_cast<int>(std::floor(wrapped(place.x, use.wrap_u) * level.width));
  const int y = static_cast<int>(std::floor(wrapped(place.y, use.wrap_v) * level.height));
  return texel(level, wrapped_texel(x, level.width, use.wrap_u), wrapped_texel(y, level.height, use.wrap_v));
}

TextureValue Texture::bilinear(const Level& level, const TexturePoint& place, const TextureUse& use) const {
  const double x = wrapped(place.x, use.wrap_u) * level.width - 0.5;
  const double y = wrapped(place.y, use.wrap_v) * level.height - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
  const float right_share = static_cast<float>(x - left), lower_share = static_cast<float>(y - top);
  const int columns[2] = {wrapped_texel(x0, level.width, use.wrap_u), wrapped_texel(x0 + 1, level.width, use.wrap_u)};
  const int rows[2] = {wrapped_texel(y0, level.height, use.wrap_v), wrapped_texel(y0 + 1, level.height, use.wrap_v)};
  const TextureValue upper = mixed(texel(level, columns[0], rows[0]), texel(level, columns[1], rows[0]), right_share);
  const TextureValue lower = mixed(texel(level, columns[0], rows[1]), texel(level, columns[1], rows[1]), right_share);
  return mixed(upper, lower, lower_share);
}

// `size`: of what is asked for, in texels of the image, at least 1. Between two levels the share grows linearly with
// the size, not with its logarithm: as steady, and without a logarithm.
TextureValue Texture::trilinear(const TexturePoint& place, double size, const TextureUse& use) const {
  const int finest = exponent_of(size), coarsest = static_cast<int>(levels_.size()) - 1;
  if (finest >= coarsest) return bilinear(levels_.back(), place, use);
  const auto level = static_cast<std::size_t>(finest);
  const float share = static_cast<float>(size / power_of_two(finest) - 1);
  const bool squares = !use.is_smooth && level == 0;
  const TextureValue fine = squares ? nearest(levels_[0], place, use) : bilinear(levels_[level], place, use);
  if (share == 0) return fine;
  return mixed(fine, bilinear(levels_[level + 1], place, use), share);
}

// The ellipse that a footprint turns a circle into: its half axes as lengths in texels, and the longer one's direction.
struct Texture::Ellipse {
  double longer = 0, shorter = 0;
  TexturePoint axis{0};  // the longer one's whole length, in places
};

Texture::Ellipse Texture::ellipse_of(const Footprint& footprint) const {
  const TexturePoint size(width(), height());
  const TexturePoint p = footprint.right * size, q = footprint.down * size;
  // Eigenvalues of J J^T, J = (p q).
  const double a = p.x * p.x + q.x * q.x, b = p.x * p.y + q.x * q.y, c = p.y * p.y + q.y * q.y;
  const double middle = (a + c) * 0.5, half = (a - c) * 0.5;
  const double spread = std::sqrt(half * half + b * b);
  Ellipse ellipse;
  ellipse.longer = std::sqrt(middle + spread);
  // The product of the axes is the determinant: no difference of nearly equal numbers.
  ellipse.shorter = ellipse.longer > 0 ? std::fabs(p.x * q.y - p.y * q.x) / ellipse.longer : 0;
  const TexturePoint direction = a > c ? TexturePoint(half + spread, b) : TexturePoint(b, spread - half);
  const double length = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  if (length > 0) ellipse.axis = direction * (ellipse.longer / length) / size;
  return ellipse;
}

double Texture::texels_across(const Footprint& footprint) const {
  const Ellipse ellipse = ellipse_of(footprint);
  return std::max({1.0, ellipse.shorter, ellipse.longer / kMostProbes});
}

TextureValue Texture::at(const TexturePoint& place, const Footprint& footprint, const TextureUse& use) const {
  const Ellipse ellipse = ellipse_of(footprint);
  const double size = std::max({1.0, ellipse.shorter, ellipse.longer / kMostProbes});
  const int probes =
      std::clamp(static_cast<int>(std::ceil(std::min(ellipse.longer / size, double{kMostProbes}))), 1, kMostProbes);
  if (probes == 1) return trilinear(place, size, use);
  TextureValue sum;
  for (int i = 0; i < probes; ++i) {
    const TextureValue value = trilinear(place + ellipse.axis * ((i + 0.5) / probes - 0.5), size, use);
    sum = {sum.r + value.r, sum.g + value.g, sum.b + value.b, sum.a + value.a};
  }
  const float share = 1 / static_cast<float>(probes);
  return {sum.r * share, sum.g * share, sum.b * share, sum.a * share};
}

}  // namespace facemap
