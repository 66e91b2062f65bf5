#include <facemap/error.h>

#include <mutex>
#include <vector>

#include "simd/floating_point_mode.h"
#include "visibility/pieces.h"
#include "visibility/ray_order.h"
#include "visibility/target_points.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

constexpr std::size_t kPiece = 1024;  // points

}  // namespace

void Viewpoint::blocked_by(const Targets& targets, std::span<FaceId> blockers, const Progress& progress) const {
  const FloatingPointMode mode;
  const std::size_t count = targets.points.size();
  check_size(blockers.size(), count);
  if (targets.tolerance != 0) throw Error("blocked_by takes no tolerance");
  check_targets(targets);
  check_points(kept_->scene, targets);
  if (count == 0) return;
  const auto skip_of = [&](std::size_t i) {
    const bool is_none = targets.faces.empty() || targets.faces[i] == kNoFace;
    return is_none ? RayMap::kSkipNone : static_cast<std::uint32_t>(targets.faces[i]);
  };
  const RayLists& near = kept_->near_lists();
  const DVector origin(kept_->origin);
  const auto offset_of = [&](std::size_t i) { return DVector(targets.points[i]) - origin; };
  const RayOrder order(kept_->executor, near, count, [&](std::size_t i) { return near.place_of(offset_of(i)); });
  std::vector<std::size_t> open;
  std::mutex adding;
  for_pieces(kept_->executor, count, kPiece, progress, [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = order[k];
      order.prefetch_after(k, targets.points.data());
      const std::optional<FaceId> blocker = near.first_blocker(order.place(k), targets.points[i], skip_of(i));
      blockers[i] = blocker.value_or(kNoFace);
      if (blocker) continue;
      const std::scoped_lock lock(adding);
      open.push_back(i);
    }
  });
  if (open.empty()) return;
  const RayLists& whole = kept_->whole_lists();
  for_pieces(kept_->executor, open.size(), kPiece, {}, [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = open[k];
      blockers[i] = *whole.first_blocker(whole.place_of(offset_of(i)), targets.points[i], skip_of(i));
    }
  });
}

}  // namespace facemap
