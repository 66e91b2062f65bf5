#include <facemap/error.h>
#include <facemap/viewpoint.h>

#include <algorithm>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "picture/shadows.h"
#include "simd/floating_point_mode.h"
#include "visibility/target_points.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

constexpr std::size_t kMostPoints = 1 << 22;  // at once

}  // namespace

void Viewpoint::prepare() const {}

void Viewpoint::visible(const Targets& targets, std::span<std::uint8_t> visible, const Progress& progress) const {
  const FloatingPointMode mode;
  check_size(visible.size(), targets.points.size());
  for (std::size_t first = 0; first < visible.size(); first += kMostPoints) {
    const std::size_t last = std::min(first + kMostPoints, visible.size());
    const AskedPoints points = asked_points(kept_->scene, targets, first, last, kept_->executor);
    std::fill(visible.begin() + first, visible.begin() + last, std::uint8_t{1});
    ShadowScratch scratch;
    clear_blocked(
        kept_->faces.solid(), kept_->origin, points, {visible.data() + first, visible.data() + first, 1, 0}, nullptr,
        [&](std::size_t point, std::uint32_t face, int side) {
          return blocks(triangle_of(kept_->scene, face), side, kept_->origin,
                        GivenPoint{targets.points[first + point]});
        },
        scratch);
    if (progress && !progress(static_cast<double>(last) / static_cast<double>(visible.size()))) throw Error("stopped");
  }
}

}  // namespace facemap
