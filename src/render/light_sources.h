#pragma once

#include <facemap/renderer.h>

#include <vector>

#include "simd/light_source.h"

namespace facemap {

/// The renderer's lights as shading takes them.
std::vector<simd::LightSource> light_sources(const std::vector<Light>& lights, Renderer::Falloff falloff);

/// A light as a point gets it, nothing in between. One sequence of operations in double, which simd::add_lights shares.
struct Arrival {
  DVector to_light;  ///< of the length `distance`; parallel light: of unit length
  double distance;   ///< world units; parallel light: 1
  double share;      ///< what distance, cone and range leave of the intensity
};

Arrival arrival(const simd::LightSource& light, const DVector& position);

/// Whether a light's cone and range hold a point at all: what a light mask asks of them. The position is that of
/// shading (material/surface_coordinates.h), also where the point was lifted. simd::find_lights_reaching is the same.
bool reaches(const simd::LightSource& light, const DVector& position);

/// Whether `reaches` can be false.
inline bool is_windowed(const simd::LightSource& light) { return light.is_spot || light.has_range; }

}  // namespace facemap
