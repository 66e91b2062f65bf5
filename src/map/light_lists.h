#pragma once

#include <facemap/light.h>
#include <facemap/parallel_light.h>
#include <facemap/point_light.h>

#include <memory>
#include <variant>
#include <vector>

namespace facemap {

/// The lists of one light, about its position or along its direction: who asks need not know which.
class LightLists {
 public:
  /// Directional lights have the exact builder whatever `builder` says. Throws Error as the maps do.
  LightLists(const Scene& scene, const Light& light, Builder builder) : map_(map_of(scene, light, builder)) {}

  bool is_blocked(const SurfacePoint& point, Counters* counters) const {
    return std::visit([&](const auto& map) { return map.is_blocked(point, counters); }, map_);
  }

  /// A SurfacePoint, or a Vector that was lifted off its face.
  template <class Point>
  bool is_lit(const Point& point, Counters* counters) const {
    return std::visit([&](const auto& map) { return map.get_lighten_up(point, counters); }, map_);
  }

  std::size_t memory_bytes() const {
    return std::visit([](const auto& map) { return map.memory_bytes(); }, map_);
  }

 private:
  using Map = std::variant<PointLight, ParallelLight>;

  static Map map_of(const Scene& scene, const Light& light, Builder builder) {
    if (light.kind == Light::Kind::Directional) return ParallelLight(scene, light.direction);
    PointLight::Options options;
    options.builder = builder;
    return PointLight(scene, light.position, options);
  }

  Map map_;
};

/// One a light; null where a light has none.
using ListsOfLights = std::vector<std::unique_ptr<LightLists>>;

}  // namespace facemap
