#include "render/light_sources.h"

#include <algorithm>
#include <cmath>

#include "math/dvector.h"
#include "math/elementary.h"

namespace facemap {
namespace {

// KHR_lights_punctual: the least difference of the cosines of the two cones, so that no edge is infinitely sharp.
constexpr double kSharpestCone = 0.001;

DVector at(const double (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

void store(const DVector& v, double (&numbers)[3]) {
  for (int i = 0; i < 3; ++i) numbers[i] = v[i];
}

simd::LightSource light_source(const Light& light, Renderer::Falloff falloff) {
  simd::LightSource source{};
  store(DVector(light.position), source.position);
  store(DVector(light.color.r, light.color.g, light.color.b), source.color);
  source.intensity = light.intensity;
  source.is_parallel = light.kind == Light::Kind::Directional;
  if (source.is_parallel) {
    store(normalized(-DVector(light.direction)), source.towards);
    return source;
  }
  source.inverse_square = light.has_falloff || falloff == Renderer::Falloff::InverseSquare;
  source.has_range = light.range < HUGE_VAL;
  source.squared_range = light.range * light.range;
  source.is_spot = light.kind == Light::Kind::Spot;
  if (source.is_spot) {
    const double inner = elementary::cos(light.inner_angle), outer = elementary::cos(light.outer_angle);
    store(normalized(DVector(light.direction)), source.axis);
    source.cone_scale = 1 / std::max(kSharpestCone, inner - outer);
    source.cone_offset = -outer * source.cone_scale;
  }
  return source;
}

// x cut to 0..1; 0 for what is not a number.
double between_0_and_1(double x) { return x > 0 ? std::min(x, 1.0) : 0; }

// What cone and range leave.
double window(const simd::LightSource& light, const DVector& to_light, double squared, double distance) {
  double share = 1;
  if (light.is_spot) {
    const double cosine = -dot(at(light.axis), to_light) / distance;
    const double edge = between_0_and_1(cosine * light.cone_scale + light.cone_offset);
    share = edge * edge;
  }
  if (light.has_range) {
    const double ratio = squared / light.squared_range;
    share *= between_0_and_1(1 - ratio * ratio);
  }
  return share;
}

}  // namespace

std::vector<simd::LightSource> light_sources(const std::vector<Light>& lights, Renderer::Falloff falloff) {
  std::vector<simd::LightSource> sources;
  for (const Light& light : lights) sources.push_back(light_source(light, falloff));
  return sources;
}

Arrival arrival(const simd::LightSource& light, const DVector& position) {
  if (light.is_parallel) return {at(light.towards), 1, 1};
  const DVector to_light = at(light.position) - position;
  const double squared = dot(to_light, to_light), distance = std::sqrt(squared);
  const double fading = light.inverse_square ? 1 / squared : 1;
  return {to_light, distance, fading * window(light, to_light, squared, distance)};
}

bool reaches(const simd::LightSource& light, const DVector& position) {
  if (!is_windowed(light)) return true;
  const DVector to_light = at(light.position) - position;
  const double squared = dot(to_light, to_light);
  return window(light, to_light, squared, std::sqrt(squared)) > 0;
}

}  // namespace facemap
