#include "visibility/face_answers.h"

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "map/nearest_hit.h"
#include "math/exact_sign.h"

namespace facemap {
namespace {

// A face is cut into a piece for each so many steps that it may take, and into no more than these.
constexpr std::size_t kStepsAPiece = 32, kMostPieces = 512;

// A step is a face of a patch; these take about as long.
constexpr std::size_t kBoxesAStep = 20, kFacesOnARayAStep = 4;

}  // namespace

FaceAnswers::FaceAnswers(const VisibleFaceSearch& search)
    : search_(search), patch_(search.faces_.scene, search.origin_, search.sides_, search.neighbours_) {}

FaceAnswers::Answer FaceAnswers::decide(std::uint32_t id, std::size_t most_steps, std::vector<CoveredPiece>* pieces) {
  if (pieces != nullptr) pieces->clear();
  const SeenFace face(search_.faces_.scene, id, search_.sides_[id], search_.origin_);
  ray_steps_ = 0;
  patch_.allow(most_steps);
  const std::size_t first_step = patch_.steps();
  const FacePiece whole(face, search_.origin_);
  pieces_.assign(1, whole);
  for (std::size_t next = 0; next < pieces_.size(); ++next) {
    const FacePiece piece = pieces_[next];
    const Outcome outcome = ask(piece);
    if (outcome == Outcome::Seen) {
      if (pieces != nullptr) pieces->clear();
      return {FaceVisibility::Visible, HiddenReason::None, direction_};
    }
    if (outcome == Outcome::Covered) {
      if (pieces != nullptr) {
        pieces->push_back({piece.scale(), piece.corners(), static_cast<FaceId>(cover_), direction_});
      }
      continue;
    }
    const std::size_t before = pieces_.size(), steps = patch_.steps() - first_step + ray_steps_;
    const bool has_steps = std::max(steps, before * kStepsAPiece) < most_steps;
    if (has_steps && before < kMostPieces) piece.divide(cut_, whole, pieces_);
    if (pieces_.size() == before) {
      if (pieces != nullptr) pieces->clear();
      return {FaceVisibility::Undecided, HiddenReason::None, Vector(0), !has_steps};
    }
  }
  return {FaceVisibility::Hidden, HiddenReason::Covered};
}

// Along the direction to the piece's middle, which becomes direction_.
FaceAnswers::Outcome FaceAnswers::ask(const FacePiece& piece) {
  const SeenFace& face = piece.face();
  direction_ = piece.middle();
  cut_ = {};
  if (!covers(face.triangle(), face.side, search_.origin_, direction_).strictly_inside) return Outcome::Open;
  const FaceId first = nearest(face);
  if (first == static_cast<FaceId>(face.id)) return Outcome::Seen;
  if (!piece.surely_holds(direction_)) return Outcome::Open;
  bool is_first = true;
  for (const std::uint32_t seed : before_) {
    if (seed == face.id) continue;
    FacePiece::Cut cut;
    if (patch_.covers(piece, seed, direction_, cut)) {
      cover_ = seed;
      return Outcome::Covered;
    }
    if (is_first) cut_ = cut;
    is_first = false;
  }
  return Outcome::Open;
}

// The face that direction_ meets first, if that is not behind `face`. Fills before_, that face first if it is solid.
FaceId FaceAnswers::nearest(const SeenFace& face) {
  const MapFaces& faces = search_.faces_;
  const Tracked t = ray_parameter({search_.origin_, direction_, face.triangle(), face.side});
  const std::size_t boxes = search_.tree_.find(direction_, t.value + t.error, found_);
  ray_steps_ += boxes / kBoxesAStep + found_.size() / kFacesOnARayAStep;
  NearestHit best(faces.scene, search_.origin_, direction_, nullptr);
  before_.clear();
  for (const std::uint32_t id : found_) {
    const int side = search_.sides_[id];
    const Covering covering = covers(triangle_of(faces.scene, id), side, search_.origin_, direction_);
    if (!covering.hit) continue;
    if (faces.has_cut_outs() && faces.cut_outs->cut().is_kept(id)) {
      if (!faces.cut_outs->is_there(id, DVector(search_.origin_), DVector(direction_))) continue;
    } else {
      before_.push_back(id);
    }
    best.meet(id, side, covering.strictly_inside);
  }
  const FaceId first = best.hit().face;
  const auto nearest = std::find(before_.begin(), before_.end(), static_cast<std::uint32_t>(first));
  if (nearest != before_.end()) std::iter_swap(before_.begin(), nearest);
  return first;
}

}  // namespace facemap
