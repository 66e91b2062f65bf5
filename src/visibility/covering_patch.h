#pragma once

#include <facemap/scene.h>
#include <facemap/vector.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/face_neighbours.h"
#include "visibility/face_piece.h"

namespace facemap {

/// Looks for patches of connected faces that cover pieces of other faces: CoveredPiece says when one does. One a
/// thread.
class CoveringPatch {
 public:
  /// `sides`, one a face, and `neighbours` must outlive this; faces of side 0 are in no patch.
  CoveringPatch(const Scene& scene, const Vector& origin, const std::vector<std::int8_t>& sides,
                const std::vector<FaceNeighbours>& neighbours);

  /// Whether the patch of `seed`, which `direction` meets, surely covers the piece, which has that direction. If not,
  /// `cut` tells of a line where something ends.
  bool covers(const FacePiece& piece, std::uint32_t seed, const Vector& direction, FacePiece::Cut& cut);

  /// How many faces a patch may have, about: less if it has outlines.
  void allow(std::size_t most_faces) { most_faces_ = most_faces; }

  /// Faces looked at so far.
  std::size_t steps() const { return steps_; }

 private:
  enum class End { None, Outline, Other };

  End spread(const FacePiece& piece, std::uint32_t seed, std::size_t most, bool across_outlines, FacePiece::Cut& cut);
  bool has_sum(const Vector& direction) const;

  const Scene& scene_;
  Vector origin_;
  const std::vector<std::int8_t>& sides_;
  const std::vector<FaceNeighbours>& neighbours_;
  std::size_t most_faces_ = 0, steps_ = 0;
  std::vector<std::uint32_t> patch_;  // those looked at
  std::vector<std::uint32_t> to_do_;
  std::vector<std::uint32_t> reached_;  // a face: by which search
  std::uint32_t search_number_ = 0;
};

}  // namespace facemap
