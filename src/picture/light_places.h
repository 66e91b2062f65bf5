#pragma once

#include <facemap/light.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace facemap {

/// Where the lights of a picture stand, or which way their light goes if it is parallel.
struct LightPlaces {
  LightPlaces(std::vector<Vector> positions) : at(std::move(positions)), is_parallel(at.size()) {}
  LightPlaces(std::initializer_list<Vector> positions) : LightPlaces(std::vector<Vector>(positions)) {}

  static LightPlaces of(const std::vector<Light>& lights) {
    std::vector<Vector> at;
    for (const Light& light : lights) {
      at.push_back(light.kind == Light::Kind::Directional ? light.direction : light.position);
    }
    LightPlaces places(std::move(at));
    for (std::size_t l = 0; l < lights.size(); ++l) places.is_parallel[l] = lights[l].kind == Light::Kind::Directional;
    return places;
  }

  std::size_t size() const { return at.size(); }
  bool any_has_a_place() const { return std::find(is_parallel.begin(), is_parallel.end(), 0) != is_parallel.end(); }

  std::vector<Vector> at;                 ///< positions; directions of parallel light
  std::vector<std::uint8_t> is_parallel;  ///< one each
};

}  // namespace facemap
