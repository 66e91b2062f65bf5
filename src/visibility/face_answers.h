#pragma once

#include <facemap/visible_faces.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "visibility/covering_patch.h"
#include "visibility/face_piece.h"
#include "visibility/visible_face_search.h"

namespace facemap {

/// Answers for one face after the other, with memory of its own: one a thread. An answer depends on the face alone.
class FaceAnswers {
 public:
  explicit FaceAnswers(const VisibleFaceSearch& search);

  struct Answer {
    FaceVisibility visibility = FaceVisibility::Undecided;
    HiddenReason reason = HiddenReason::None;
    Vector witness{0};
    bool ran_out = false;  ///< more steps may decide it
  };

  /// The face is not seen edge-on. Looks for a direction that sees a piece of it, and for faces that cover it; cuts
  /// pieces up that have neither, until that has taken so many steps of about 0.1 microseconds. `pieces`, if not null,
  /// becomes those that are covered.
  Answer decide(std::uint32_t face, std::size_t most_steps, std::vector<CoveredPiece>* pieces = nullptr);

 private:
  enum class Outcome { Seen, Covered, Open };

  Outcome ask(const FacePiece& piece);
  FaceId nearest(const SeenFace& face);

  const VisibleFaceSearch& search_;
  CoveringPatch patch_;
  std::size_t ray_steps_ = 0;  // of the latest face
  Vector direction_{0};        // of the latest piece asked
  std::uint32_t cover_ = 0;
  FacePiece::Cut cut_;  // where what might have covered it ends
  std::vector<FacePiece> pieces_;
  std::vector<std::uint32_t> found_;   // by a ray
  std::vector<std::uint32_t> before_;  // solid faces that the ray meets
};

}  // namespace facemap
