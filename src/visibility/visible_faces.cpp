#include <facemap/error.h>
#include <facemap/viewpoint.h>

#include <string>

#include "simd/floating_point_mode.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {

VisibleFaces Viewpoint::visible_faces(const Progress& progress) const {
  const FloatingPointMode mode;
  return kept_->face_search().find(kept_->executor, progress);
}

std::vector<CoveredPiece> Viewpoint::covered_pieces(FaceId face) const {
  const FloatingPointMode mode;
  if (face < 0 || static_cast<std::size_t>(face) >= scene().face_count()) {
    throw Error("there is no face " + std::to_string(face) + ", but " + std::to_string(scene().face_count()));
  }
  return kept_->face_search().covered_pieces(static_cast<std::uint32_t>(face));
}

std::vector<std::uint8_t> Viewpoint::visible_vertices(const Progress& progress) const {
  std::vector<std::uint8_t> answers(scene().mesh().positions.size());
  visible({scene().mesh().positions}, answers, progress);
  return answers;
}

}  // namespace facemap
