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

const LightBounds* VisiblePoints::bounds() {
  const std::optional<LightBounds>& made = bounds_.get([&] {
    const Scene& scene = faces_.solid();
    return std::make_unique<std::optional<LightBounds>>(
        LightBounds::find(scene, origin_, nullptr, find_face_neighbours(scene), false));
  });
  return made ? &*made : nullptr;
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
  if (faces_.has_cut_outs()) cut_out_lists();
  if (faces_.solid().kept_faces().empty()) return;
  bounds();
  lists();
}

void VisiblePoints::ask(const Viewpoint::Targets& targets, std::span<std::uint8_t> visible,
                        const Viewpoint::Progress& progress) {
  const PointQuestion question{faces_.solid(), origin_, targets, visible};
  if (question.size() == 0) return;
  ToldProgress told(progress, question.size() * (faces_.has_cut_outs() ? 2 : 1));
  if (question.faces.kept_faces().empty()) {
    check_points(question.faces, targets);
    std::fill(visible.begin(), visible.end(), std::uint8_t{1});
    told.add(question.size());
  } else if (targets.tolerance > 0) {
    ask_listed(question, told);
  } else {
    ask_solid(question, told);
  }
  if (faces_.has_cut_outs()) ask_lists(cut_out_lists(), question, told);
}

void VisiblePoints::ask_solid(const PointQuestion& question, ToldProgress& told) {
  const std::size_t count = question.size();
  const PointCosts costs(question.faces.face_count());
  const double loss = costs.by_faces(count) - costs.by_lists(count);
  if (loss > 0 && (lists_.if_made() != nullptr || by_faces_.add(loss, costs.making_lists()))) {
    return ask_listed(question, told);
  }
  const bool has_bounds =
      bounds_.if_made() != nullptr || without_bounds_.add(costs.saved_by_bounds(count), costs.making_bounds());
  ask_faces(question, has_bounds ? bounds() : nullptr, executor_, spares_, told);
}

// By lists of solid faces alone.
void VisiblePoints::ask_listed(const PointQuestion& question, ToldProgress& told) {
  check_points(question.faces, question.targets);
  const PointLists& kept = lists();
  if (!question.targets.faces.empty() || question.targets.tolerance > 0) {
    std::fill(question.visible.begin(), question.visible.end(), std::uint8_t{1});
    return ask_lists(kept, question, told);
  }
  for_listed_pieces(question, told, [&](std::size_t first, std::size_t count) {
    kept.get_lighten_up(question.targets.points.subspan(first, count), question.visible.subspan(first, count));
  });
}

// Of the points that are visible so far.
void VisiblePoints::ask_lists(const PointLists& lists, const PointQuestion& question, ToldProgress& told) {
  const Viewpoint::Targets& targets = question.targets;
  for_listed_pieces(question, told, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      const FaceId own = targets.faces.empty() ? kNoFace : targets.faces[i];
      if (question.visible[i] != 0) question.visible[i] = !lists.hides(targets.points[i], own, targets.tolerance);
    }
  });
}

template <class Body>
void VisiblePoints::for_listed_pieces(const PointQuestion& question, ToldProgress& told, const Body& body) {
  const std::size_t pieces = (question.size() + kListedPiece - 1) / kListedPiece;
  const auto task = [&](std::size_t piece, int) {
    const std::size_t first = piece * kListedPiece, count = std::min(kListedPiece, question.size() - first);
    body(first, count);
    told.add(count);
  };
  if (pieces == 1) return task(0, 0);
  executor_.for_each(pieces, task);
}

std::size_t VisiblePoints::memory_bytes() const {
  std::size_t bytes = sizeof(*this) + spares_.memory_bytes();
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
