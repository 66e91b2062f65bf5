#pragma once

#include <facemap/renderer.h>

#include "math/dvector.h"

namespace facemap {

/// Light that comes from everywhere: evenly, and from a sky of two colours.
class Surroundings {
 public:
  explicit Surroundings(const Renderer::Options& options)
      : even_(vector_of(options.ambient)),
        up_(vector_of(options.sky_up)),
        down_(vector_of(options.sky_down)),
        axis_(normalized(DVector(options.up))) {}

  bool are_dark() const { return even_ == DVector(0) && up_ == DVector(0) && down_ == DVector(0); }

  /// What a white surface of this unit normal sends on.
  DVector at(const DVector& normal) const {
    const double share = 0.5 + 0.5 * dot(normal, axis_);
    return even_ + (down_ + (up_ - down_) * share);
  }

 private:
  static DVector vector_of(const Color& color) { return {color.r, color.g, color.b}; }

  DVector even_, up_, down_, axis_;
};

}  // namespace facemap
