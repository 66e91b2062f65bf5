#pragma once

#include <facemap/texture.h>

#include <algorithm>
#include <cmath>

/// What lies beyond the border of an image.
namespace facemap {

/// Beyond this, in widths of the texture, a place has no digits left to tell texels apart.
inline constexpr double kFarthestPlace = 0x1p40;

/// A coordinate of a place brought to within the image's own range: 0..1, twice as far for mirrored ones.
inline double wrapped(double x, TextureUse::Wrap wrap) {
  if (!(std::fabs(x) < kFarthestPlace)) return 0;
  switch (wrap) {
    case TextureUse::Wrap::Repeat:
      return x - std::floor(x);
    case TextureUse::Wrap::Mirror:
      return x - 2 * std::floor(x * 0.5);
    case TextureUse::Wrap::Clamp:
      return std::clamp(x, -1.0, 2.0);
  }
  return 0;
}

/// The texel that stands at `i` of a wrapped place: i is within one texel of the range that wrapped() gives.
inline int wrapped_texel(int i, int size, TextureUse::Wrap wrap) {
  switch (wrap) {
    case TextureUse::Wrap::Repeat:
      if (i < 0) i += size;
      if (i >= size) i -= size;
      break;
    case TextureUse::Wrap::Mirror:
      if (i < 0) i = -1 - i;
      if (i >= size) i = 2 * size - 1 - i;
      break;
    case TextureUse::Wrap::Clamp:
      break;
  }
  return std::clamp(i, 0, size - 1);
}

/// The texel, of `size` in a row, in which a coordinate of a place lies.
inline int texel_under(double x, int size, TextureUse::Wrap wrap) {
  return wrapped_texel(static_cast<int>(std::floor(wrapped(x, wrap) * size)), size, wrap);
}

}  // namespace facemap
