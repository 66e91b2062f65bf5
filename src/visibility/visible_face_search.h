#pragma once

#include <facemap/viewpoint.h>
#include <facemap/visible_faces.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "scene/face_neighbours.h"
#include "visibility/face_tree.h"
#include "visibility/told_progress.h"

namespace facemap {

/// Which faces are visible from an origin: for each face a direction that sees it, or pieces that others cover. What
/// it keeps may be asked by several threads.
class VisibleFaceSearch {
 public:
  VisibleFaceSearch(const MapFaces& faces, const Vector& origin, const Executor& executor);

  VisibleFaces find(const Executor& executor, const Viewpoint::Progress& progress) const;

  /// Pieces that make up `face`, each with what covers it; none if that is not why it is hidden, or it is not known to
  /// be.
  std::vector<CoveredPiece> covered_pieces(std::uint32_t face) const;

  std::size_t memory_bytes() const noexcept;

 private:
  friend class FaceAnswers;

  void decide(std::vector<std::uint32_t>& open, std::size_t steps, std::size_t faces_a_task, const Executor& executor,
              ToldProgress& told, VisibleFaces& answers) const;

  MapFaces faces_;
  Vector origin_;
  std::vector<std::int8_t> sides_;          // 0 for faces that no map has, too
  std::vector<FaceNeighbours> neighbours_;  // of solid faces
  FaceTree tree_;
  std::size_t share_;  // of steps, that each face may take
};

}  // namespace facemap
