#pragma once

#include <facemap/texture.h>

#include "math/elementary.h"
#include "scene/surface_coordinates.h"

namespace facemap {

/// From a corner's texture coordinates to places of an image (0..1, x to the right, y down): an affine map.
class TexturePlace {
 public:
  explicit TexturePlace(const TextureUse& use) {
    const double c = elementary::cos(use.rotation), s = elementary::sin(use.rotation);
    x_ = {c * use.scale.x, -s * use.scale.y};
    y_ = {s * use.scale.x, c * use.scale.y};
    origin_ = TexturePoint(use.offset);
    if (use.is_v_down) return;
    y_ = -y_;
    origin_.y = 1 - origin_.y;
  }

  TexturePoint at(const TexturePoint& uv) const { return origin_ + moved(uv); }

  /// A difference of places.
  TexturePoint moved(const TexturePoint& uv) const { return {x_.x * uv.x + x_.y * uv.y, y_.x * uv.x + y_.y * uv.y}; }

 private:
  TexturePoint x_{0}, y_{0}, origin_{0};
};

}  // namespace facemap
