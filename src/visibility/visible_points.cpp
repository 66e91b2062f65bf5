#include "visibility/visible_points.h"

#include <facemap/error.h>
#include <facemap/viewpoint.h>

#include <algorithm>
#include <memory>

#include "scene/face_neighbours.h"
#include "simd/floating_point_mode.h"
#include "visibility/point_costs.h"
#include "visibility/target_points.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

constexpr std::size_t kListedPiece = 1024;  // points of a task that asks lists

}  // namespace

const std::optional<LightBounds>& VisiblePoints::bounds() {
  return bounds_.get([&] {
    auto made = std::make_unique<std::optional<LightBounds>>();
    const Scene& scene = faces_.solid();
    if (!can_ask_lists(scene, origin_, 0)) return made;
    *made = LightBounds::find(scene, origin_, nullptr, find_face_neighbours(scene));
    if (*made && (*made)->lists() == nullptr) made->reset();
    return made;
  });
}

const PointLists& VisiblePoints::lists() {
  return lists_.get([&] { return std::make_unique<PointLists>(MapFaces{faces_.solid(), nullptr, false}, origin_); });
}

const PointLists& VisiblePoints::cut_out_lists() {
  return cut_out_lists_.get([&] {
    return std::make_unique<PointLists>(MapFaces{faces_.scene, faces_.cut_outs, true}, origin_);
  });
}

void VisiblePoints::prepare() {
  if (!bounds()) lists();
  if (faces_.has_cut_outs()) cut_out_lists();
}

void VisiblePoints::ask(const Viewpoint::Targets& targets, std::span<std::uint8_t> visible,
                        const Viewpoint::Progress& progress) {
  const PointQuestion question{faces_.solid(), origin_, targets, visible};
  if (question.size() == 0) return;
  ToldProgress told(progress, question.size() * (faces_.has_cut_outs() ? 2 : 1));
  if (targets.tolerance > 0) {
    check_points(question.faces, targets);
    std::fill(visible.begin(), visible.end(), std::uint8_t{1});
    ask_lists(lists(), question, told);
  } else {
    ask_solid(question, told);
  }
  if (faces_.has_cut_outs()) ask_lists(cut_out_lists(), question, told);
}

bool VisiblePoints::is_worth_making(double loss, double making) {
  const std::scoped_lock lock(losing_);
  lost_ += std::max(loss, 0.0);
  return lost_ >= making;
}

void VisiblePoints::ask_solid(const PointQuestion& question, ToldProgress& told) {
  const PointCosts costs{question.faces.face_count()};
  const std::size_t count = question.size();
  const double by_faces = costs.by_faces(count);
  const std::optional<LightBounds>* kept = bounds_.if_made();
  if (kept == nullptr && is_worth_making(by_faces - costs.by_bounds(count), costs.making_bounds())) kept = &bounds();
  if (kept != nullptr && *kept) {
    return ask_bounds(**kept, question, executor_, bounds_spares_, shadow_spares_, told);
  }
  const double loss = by_faces - costs.by_lists(count);
  const bool has_lists = lists_.if_made() != nullptr;
  if (has_lists ? loss > 0 : kept != nullptr && is_worth_making(loss, costs.making_bounds() + costs.making_lists())) {
    check_points(question.faces, question.targets);
    std::fill(question.visible.begin(), question.visible.end(), std::uint8_t{1});
    return ask_lists(lists(), question, told);
  }
  ask_faces(question, executor_, shadow_spares_, told);
}

// Of the points that are visible so far.
void VisiblePoints::ask_lists(const PointLists& lists, const PointQuestion& question, ToldProgress& told) {
  const Viewpoint::Targets& targets = question.targets;
  executor_.for_each((question.size() + kListedPiece - 1) / kListedPiece, [&](std::size_t piece, int) {
    const std::size_t first = piece * kListedPiece, last = std::min(first + kListedPiece, question.size());
    for (std::size_t i = first; i < last; ++i) {
      const FaceId own = targets.faces.empty() ? kNoFace : targets.faces[i];
      if (question.visible[i] != 0) question.visible[i] = !lists.hides(targets.points[i], own, targets.tolerance);
    }
    told.add(last - first);
  });
}

std::size_t VisiblePoints::memory_bytes() const {
  std::size_t bytes = sizeof(*this) + shadow_spares_.memory_bytes() + bounds_spares_.memory_bytes();
  if (const auto* kept = bounds_.if_made(); kept != nullptr && *kept) bytes += (*kept)->memory_bytes();
  for (const auto* kept : {lists_.if_made(), cut_out_lists_.if_made()})
    bytes += kept != nullptr ? kept->memory_bytes() : 0;
  return bytes;
}

void Viewpoint::prepare() const {
  const FloatingPointMode mode;
  kept_->visible_points.prepare();
}

void Viewpoint::visible(const Targets& targets, std::span<std::uint8_t> visible, const Progress& progress) const {
  const FloatingPointMode mode;
  check_size(visible.size(), targets.points.size());
  check_targets(targets);
  kept_->visible_points.ask(targets, visible, progress);
}

}  // namespace facemap
