#pragma once

#include <facemap/material.h>

#include <cstdint>
#include <string>
#include <vector>

#include "image/decode_image.h"
#include "scene/surface_coordinates.h"
#include "scene/texture_place.h"

namespace facemap {

/// What of a material's surface is there: a bit a texel of the image that says so.
///
/// A texel is there unless its opacity is below the cutoff, in float32: b / 255 for the byte b of a channel, correctly
/// rounded; times gain plus base; times the material's opacity. So a cutoff written as b / 255 keeps the texels of b.
class AlphaMask {
 public:
  enum class Kind {
    Solid,   ///< all of it is there
    Gone,    ///< nothing is
    CutOut,  ///< it depends on the texel
  };

  /// A material that has no image of its opacity, or none that can be read: Solid or Gone.
  explicit AlphaMask(const Material& material);

  /// `image`: that of image_of_opacity(material).
  AlphaMask(const Material& material, const DecodedImage& image);

  Kind kind() const noexcept { return kind_; }

  /// Of a CutOut: whether the texel under a place given by texture coordinates is there.
  bool is_there(const TexturePoint& uv) const;

 private:
  TextureUse use_;
  TexturePlace place_;
  Kind kind_ = Kind::Solid;
  int width_ = 0, height_ = 0;
  std::vector<std::uint64_t> bits_;
};

/// Which of a material's images says what of it is there: that of opacity_map, or else the alpha of diffuse_map. None
/// for materials that are opaque whatever it says.
const TextureUse* image_of_opacity(const Material& material);

}  // namespace facemap
