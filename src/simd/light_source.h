#pragma once

namespace facemap::simd {

/// A light as shading takes it. docs/lights.md has the formulas; render/light_sources.h makes it of a Light.
struct LightSource {
  double position[3];
  double color[3];
  double intensity;
  double towards[3];  ///< parallel light: unit vector to where it comes from
  double axis[3];     ///< spot: unit vector, the way it goes
  double cone_scale, cone_offset;
  double squared_range;
  bool is_parallel, is_spot, has_range;
  bool inverse_square;  ///< fades by the squared distance
};

}  // namespace facemap::simd
