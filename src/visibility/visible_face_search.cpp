#include "visibility/visible_face_search.h"

#include <algorithm>
#include <memory>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "visibility/face_answers.h"
#include "visibility/told_progress.h"

namespace facemap {
namespace {

constexpr std::size_t kFewestSides = 4096;  // a task
constexpr std::size_t kFacesATask = 1024;

std::vector<std::int8_t> sides_of(const Scene& scene, const Vector& origin, const Executor& executor) {
  std::vector<std::int8_t> sides(scene.face_count(), 0);
  const std::vector<std::uint32_t>& kept = scene.kept_faces();
  for_ranges(executor, kept.size(), kFewestSides, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) {
      sides[kept[i]] = static_cast<std::int8_t>(side(triangle_of(scene, kept[i]), origin));
    }
  });
  return sides;
}

std::vector<std::uint32_t> not_edge_on(const Scene& scene, const std::vector<std::int8_t>& sides) {
  std::vector<std::uint32_t> faces;
  std::copy_if(scene.kept_faces().begin(), scene.kept_faces().end(), std::back_inserter(faces),
               [&](std::uint32_t face) { return sides[face] != 0; });
  return faces;
}

}  // namespace

VisibleFaceSearch::VisibleFaceSearch(const MapFaces& faces, const Vector& origin, const Executor& executor)
    : faces_(faces),
      origin_(origin),
      sides_(sides_of(faces.all(), origin, executor)),
      neighbours_(find_face_neighbours(faces.solid())),
      tree_(faces.scene, not_edge_on(faces.all(), sides_), origin, executor) {}

VisibleFaces VisibleFaceSearch::find(const Executor& executor, const Viewpoint::Progress& progress) const {
  const std::size_t count = sides_.size();
  VisibleFaces answers{std::vector<FaceVisibility>(count, FaceVisibility::Hidden),
                       std::vector<Vector>(count, Vector(0)), std::vector<HiddenReason>(count, HiddenReason::LeftOut)};
  for (const std::uint32_t face : faces_.all().kept_faces()) answers.reasons[face] = HiddenReason::EdgeOn;
  const std::vector<std::uint32_t> order = tree_.in_order(count);
  std::vector<std::unique_ptr<FaceAnswers>> workers(static_cast<std::size_t>(executor.threads()));
  ToldProgress told(progress, order.size());
  executor.for_each((order.size() + kFacesATask - 1) / kFacesATask, [&](std::size_t task, int worker) {
    std::unique_ptr<FaceAnswers>& own = workers[static_cast<std::size_t>(worker)];
    if (own == nullptr) own = std::make_unique<FaceAnswers>(*this);
    const std::size_t first = task * kFacesATask, last = std::min(first + kFacesATask, order.size());
    for (std::size_t i = first; i < last; ++i) {
      const FaceAnswers::Answer answer = own->decide(order[i]);
      answers.faces[order[i]] = answer.visibility;
      answers.witnesses[order[i]] = answer.witness;
      answers.reasons[order[i]] = answer.reason;
    }
    told.add(last - first);
  });
  return answers;
}

std::vector<CoveredPiece> VisibleFaceSearch::covered_pieces(std::uint32_t face) const {
  std::vector<CoveredPiece> pieces;
  if (sides_[face] == 0) return pieces;
  const FaceAnswers::Answer answer = FaceAnswers(*this).decide(face, &pieces);
  if (answer.reason != HiddenReason::Covered) pieces.clear();
  return pieces;
}

std::size_t VisibleFaceSearch::memory_bytes() const noexcept {
  return sides_.capacity() * sizeof sides_[0] + neighbours_.capacity() * sizeof neighbours_[0] + tree_.memory_bytes();
}

}  // namespace facemap
