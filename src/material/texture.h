#pragma once

#include <facemap/texture.h>

#include <cstdint>
#include <vector>

#include "image/decode_image.h"
#include "material/footprint.h"

namespace facemap {

/// Four channels of a texture, 0..1; colours are linear.
struct TextureValue {
  float r = 0, g = 0, b = 0, a = 0;
};

/// What the levels of an image hold.
enum class Encoding {
  Srgb,     ///< colours: averaged in linear light
  Linear,   ///< numbers: roughness, normals, heights
  CutOuts,  ///< colours as well, of which those of clear texels do not count: they take the colours around them
};

/// A decoded image and the same at half the size, and so on to a single texel. Its places run from (0, 0), its upper
/// left corner, to (1, 1). Const members may be called by several threads together.
class Texture {
 public:
  /// Probes along the longer axis of a footprint, at most: beyond that a surface seen at a grazing angle is blurred.
  static constexpr int kMostProbes = 8;

  Texture(DecodedImage&& image, Encoding encoding);

  int width() const noexcept { return levels_[0].width; }
  int height() const noexcept { return levels_[0].height; }

  /// The mean over a footprint about `place`: up to kMostProbes trilinear values along its longer axis, each from the
  /// two levels whose texels are about as large as its shorter axis. Where texels are larger than the footprint they
  /// are interpolated, or shown as squares unless `use.is_smooth`. Of `use`, only wraps and is_smooth matter.
  TextureValue at(const TexturePoint& place, const Footprint& footprint, const TextureUse& use) const;

  /// How wide a footprint's shorter axis is in texels, at least 1.
  double texels_across(const Footprint& footprint) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
  };
  struct Ellipse;
  Ellipse ellipse_of(const Footprint& footprint) const;
  TextureValue trilinear(const TexturePoint& place, double size, const TextureUse& use) const;
  TextureValue bilinear(const Level& level, const TexturePoint& place, const TextureUse& use) const;
  TextureValue nearest(const Level& level, const TexturePoint& place, const TextureUse& use) const;
  TextureValue texel(const Level& level, int x, int y) const;
  void add_levels();
  void fill_clear_texels();
  bool is_colour() const noexcept { return encoding_ != Encoding::Linear; }

  Encoding encoding_;
  const float* linear_;        // of the 256 values of a colour channel
  std::vector<Level> levels_;  // the image first
};

}  // namespace facemap
