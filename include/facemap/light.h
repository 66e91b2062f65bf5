#pragma once

#include <facemap/color.h>
#include <facemap/vector.h>

#include <limits>

namespace facemap {

/// A light as a user states it. Radiance = colour * intensity * cos [/ distance^2] [* cone] [* range]: docs/lights.md.
struct Light {
  enum class Kind {
    Point,        ///< shines in all directions from its position
    Spot,         ///< shines within a cone from its position
    Directional,  ///< shines everywhere along its direction; has no position
  };

  Vector position{0};
  Color color{1, 1, 1};
  float intensity = 1;
  Kind kind = Kind::Point;
  Vector direction{0, 0, -1};                              ///< the way the light goes; need not be of unit length
  double inner_angle = 0;                                  ///< radians from the direction: full intensity within
  double outer_angle = 0.78539816339744831;                ///< radians from the direction: nothing beyond
  bool has_falloff = false;                                ///< by the squared distance, whatever the renderer's default
  double range = std::numeric_limits<double>::infinity();  ///< world units: nothing farther than this
};

}  // namespace facemap
