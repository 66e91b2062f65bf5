#include "visibility/visible_face_search.h"

#include <algorithm>
#include <memory>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "visibility/face_answers.h"

namespace facemap {
namespace {

constexpr std::size_t kFewestSides = 4096;  // a task
constexpr std::size_t kFacesATask = 512;

// Faces may take so many steps together, about, and each at least and at most so many. Those that need more than their
// share have a second one, of fewer together.
constexpr std::size_t kStepsTogether = std::size_t{1} << 27, kMoreStepsTogether = 1 << 22;
constexpr std::size_t kFewestSteps = 1 << 12, kMostSteps = 1 << 20;
constexpr std::size_t kShareGrowth = 4;  // a second share is a multiple of the first, by a power of this

std::size_t share_of(std::size_t steps, std::size_t faces) {
  return std::clamp(steps / std::max<std::size_t>(faces, 1), kFewestSteps, kMostSteps);
}

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
      tree_(faces.scene, not_edge_on(faces.all(), sides_), origin, executor),
      share_(share_of(kStepsTogether, faces.all().kept_faces().size())) {}

// Decides faces, each in at most so many steps, and leaves of them those that need more.
void VisibleFaceSearch::decide(std::vector<std::uint32_t>& open, std::size_t steps, std::size_t faces_a_task,
                               const Executor& executor, ToldProgress& told, VisibleFaces& answers) const {
  std::vector<std::unique_ptr<FaceAnswers>> workers(static_cast<std::size_t>(executor.threads()));
  std::vector<std::uint8_t> ran_out(open.size());
  executor.for_each((open.size() + faces_a_task - 1) / faces_a_task, [&](std::size_t task, int worker) {
    std::unique_ptr<FaceAnswers>& own = workers[static_cast<std::size_t>(worker)];
    if (own == nullptr) own = std::make_unique<FaceAnswers>(*this);
    const std::size_t first = task * faces_a_task, last = std::min(first + faces_a_task, open.size());
    for (std::size_t i = first; i < last; ++i) {
      const FaceAnswers::Answer answer = own->decide(open[i], steps);
      answers.faces[open[i]] = answer.visibility;
      answers.witnesses[open[i]] = answer.witness;
      answers.reasons[open[i]] = answer.reason;
      ran_out[i] = answer.ran_out;
    }
    told.add(static_cast<std::size_t>(std::count(ran_out.begin() + first, ran_out.begin() + last, 0)));
  });
  std::size_t left = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (ran_out[i] != 0) open[left++] = open[i];
  }
  open.resize(left);
}

VisibleFaces VisibleFaceSearch::find(const Executor& executor, const Viewpoint::Progress& progress) const {
  const std::size_t count = sides_.size();
  VisibleFaces answers{std::vector<FaceVisibility>(count, FaceVisibility::Hidden),
                       std::vector<Vector>(count, Vector(0)), std::vector<HiddenReason>(count, HiddenReason::LeftOut)};
  for (const std::uint32_t face : faces_.all().kept_faces()) answers.reasons[face] = HiddenReason::EdgeOn;
  std::vector<std::uint32_t> open = tree_.in_order(count);
  ToldProgress told(progress, std::max<std::size_t>(open.size(), 1));
  decide(open, share_, kFacesATask, executor, told, answers);
  const std::size_t most = share_of(kMoreStepsTogether, open.size());
  std::size_t steps = share_;
  while (steps * kShareGrowth <= most) steps *= kShareGrowth;
  if (steps > share_) decide(open, steps, 1, executor, told, answers);
  told.add(open.size());
  return answers;
}

// With each share that the face may have had.
std::vector<CoveredPiece> VisibleFaceSearch::covered_pieces(std::uint32_t face) const {
  std::vector<CoveredPiece> pieces;
  if (sides_[face] == 0) return pieces;
  FaceAnswers answers(*this);
  std::size_t steps = share_;
  while (answers.decide(face, steps, &pieces).ran_out && steps <= kMostSteps) steps *= kShareGrowth;
  return pieces;
}

std::size_t VisibleFaceSearch::memory_bytes() const noexcept {
  return sides_.capacity() * sizeof sides_[0] + neighbours_.capacity() * sizeof neighbours_[0] + tree_.memory_bytes();
}

}  // namespace facemap
