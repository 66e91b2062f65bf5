#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "parallel/executor.h"
#include "picture/decide_points.h"
#include "picture/light_bounds.h"
#include "picture/light_places.h"
#include "scene/closed_parts.h"

namespace facemap {

/// The bounds of all lights of a scene, kept from picture to picture.
class KeptBounds {
 public:
  /// `closed`, or null: what the camera is `outside` of (ClosedParts::outside) decides which faces may be left out, so
  /// the bounds are good for cameras of the same answer only. Parallel lights have none. Lights are tasks of the
  /// executor.
  void make(const Scene& scene, const LightPlaces& lights, const ClosedParts* closed,
            const std::vector<std::uint8_t>& outside_camera, const Executor& executor);

  bool are_made() const noexcept { return !of_lights_.empty(); }

  /// Those of a light, or null where there are none for such a camera.
  const LightBounds* of(std::size_t light, const std::vector<std::uint8_t>& outside_camera) const;

  /// Whether a light's bounds save more than they cost, after a picture: without lists if they decide enough of its
  /// points, with lists if those held few enough faces against the others.
  static bool are_worth_keeping(const DecidedCount& count, bool has_lists, std::size_t pairs) {
    const auto asked = static_cast<double>(count.asked);
    return has_lists ? static_cast<double>(pairs) <= kMostPairs * asked
                     : static_cast<double>(count.decided) >= kLeastDecided * asked;
  }

  /// Gives up those of a light. Several threads may do so, for a light each.
  void drop(std::size_t light) { of_lights_[light].reset(); }

  /// Gives up the working memory if no light has bounds any more. Not while a picture is made.
  void tidy();

  /// One a worker of the executor.
  DecidedPoints& work(int worker) { return work_[static_cast<std::size_t>(worker)]; }

  std::size_t memory_bytes() const noexcept;

 private:
  // Shares of the points asked.
  static constexpr double kLeastDecided = 0.3, kMostPairs = 3;

  std::vector<std::uint8_t> outside_camera_;
  std::vector<std::optional<LightBounds>> of_lights_;
  std::vector<DecidedPoints> work_;
};

}  // namespace facemap
