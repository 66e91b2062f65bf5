#pragma once

#include <facemap/light.h>
#include <facemap/parallel_light.h>
#include <facemap/point_light.h>

#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace facemap {

/// The lists of one light, about its position or along its direction: who asks need not know which.
class LightLists {
 public:
  /// Directional lights have the exact builder whatever `options` say. Throws Error as the maps do.
  LightLists(const Scene& scene, const Light& light, const PointLight::Options& options)
      : map_(map_of(scene, light, options)) {}

  /// Lists made by the caller.
  explicit LightLists(PointLight&& map) : map_(std::move(map)) {}

  bool is_blocked(const SurfacePoint& point, Counters* counters) const {
    return std::visit([&](const auto& map) { return map.is_blocked(point, counters); }, map_);
  }

  /// Whether the light falls on the side of the point's face that is seen: strictly.
  bool is_before(const SurfacePoint& point) const {
    return std::visit([&](const auto& map) { return map.side(point.face) * point.side > 0; }, map_);
  }

  /// A SurfacePoint, or a Vector that was lifted off its face.
  template <class Point>
  bool is_lit(const Point& point, Counters* counters) const {
    return std::visit([&](const auto& map) { return map.get_lighten_up(point, counters); }, map_);
  }

  /// As ParallelLight has it; never an answer for a light with a place.
  std::optional<bool> is_blocked_around(const DVector& point, double error, FaceId skip, Counters* counters) const {
    const auto* along = std::get_if<ParallelLight>(&map_);
    return along != nullptr ? along->is_blocked_around(point, error, skip, counters) : std::nullopt;
  }

  std::size_t memory_bytes() const {
    return std::visit([](const auto& map) { return map.memory_bytes(); }, map_);
  }

 private:
  using Map = std::variant<PointLight, ParallelLight>;

  static Map map_of(const Scene& scene, const Light& light, const PointLight::Options& options) {
    if (light.kind != Light::Kind::Directional) return PointLight(scene, light.position, options);
    ParallelLight::Options parallel;
    parallel.cut_outs = options.cut_outs;
    parallel.max_texture_pixels = options.max_texture_pixels;
    return ParallelLight(scene, light.direction, parallel);
  }

  Map map_;
};

/// One a light; null where a light has none.
using ListsOfLights = std::vector<std::unique_ptr<LightLists>>;

}  // namespace facemap
