#include "visibility/covering_patch.h"

#include <algorithm>

#include "map/face_planes.h"
#include "math/exact_sign.h"

namespace facemap {
namespace {

// Where outlines end few faces meet: a patch that goes on for long seldom covers anything.
constexpr std::size_t kShareAcrossOutlines = 32;

}  // namespace

CoveringPatch::CoveringPatch(const Scene& scene, const Vector& origin, const std::vector<std::int8_t>& sides,
                             const std::vector<FaceNeighbours>& neighbours)
    : scene_(scene), origin_(origin), sides_(sides), neighbours_(neighbours), reached_(sides.size(), 0) {}

// Of faces that are all turned the same way, or else of both.
bool CoveringPatch::covers(const FacePiece& piece, std::uint32_t seed, const Vector& direction, FacePiece::Cut& cut) {
  const End end = spread(piece, seed, most_faces_, false, cut);
  if (end != End::Outline) return end == End::None;
  FacePiece::Cut other;
  return spread(piece, seed, most_faces_ / kShareAcrossOutlines, true, other) == End::None && has_sum(direction);
}

// Goes from face to face across edges that the piece may meet.
CoveringPatch::End CoveringPatch::spread(const FacePiece& piece, std::uint32_t seed, std::size_t most,
                                         bool across_outlines, FacePiece::Cut& cut) {
  if (++search_number_ == 0) {
    std::fill(reached_.begin(), reached_.end(), 0u);
    search_number_ = 1;
  }
  patch_.clear();
  to_do_.assign(1, seed);
  reached_[seed] = search_number_;
  while (!to_do_.empty()) {
    const std::uint32_t id = to_do_.back();
    to_do_.pop_back();
    patch_.push_back(id);
    ++steps_;
    if (patch_.size() > most) return End::Other;
    const SeenFace face(scene_, id, sides_[id], origin_);
    if (!piece.surely_yields_to(face)) {
      cut = piece.along_plane(face);
      return End::Other;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t other = neighbours_[id][k];
      const bool is_joined = other != kNoNeighbour && sides_[other] != 0;
      const bool goes_on = is_joined && (across_outlines || sides_[other] == sides_[id]);
      if (goes_on && reached_[other] == search_number_) continue;
      if (!piece.may_meet(face.vertices[k], face.vertices[(k + 1) % 3])) continue;
      if (!goes_on) {
        cut = piece.along_edge(face, k);
        return is_joined ? End::Outline : End::Other;
      }
      reached_[other] = search_number_;
      to_do_.push_back(other);
    }
  }
  return End::None;
}

// Whether more faces of the patch that the direction meets are turned one way than the other. Not if it meets an edge.
bool CoveringPatch::has_sum(const Vector& direction) const {
  int sum = 0;
  for (const std::uint32_t id : patch_) {
    const Covering covering = facemap::covers(triangle_of(scene_, id), sides_[id], origin_, direction);
    if (!covering.hit) continue;
    if (!covering.strictly_inside) return false;
    sum += sides_[id];
  }
  return sum != 0;
}

}  // namespace facemap
