#include "visibility/own_face.h"

#include "picture/near_face.h"

namespace facemap {
namespace {

// Bounds say what is behind a patch of faces by more than twice this, relative (simd::kShadowDepthFactor): points that
// are hardly behind a face are not in the dark for a patch with it.
constexpr double kSurelyBehind = 0x1p-17;

}  // namespace

bool may_be_dark_by_own(const PointQuestion& question, const AskedPoints& points, std::uint32_t point) {
  const std::uint32_t own = points.faces[point];
  if (own == kNoOwnFace || !question.faces.is_kept(own)) return false;
  const Triangle corners = triangle_of(question.faces, own);
  const int own_side = side(corners, question.origin);
  if (own_side == 0) return false;
  const DVector D = place_of(points, point) - DVector(question.origin);
  const NearFace face = near_face(own, own_side, corners, question.origin);
  return verdict_on(face, (1 - kSurelyBehind) * D, error_of(points, point)) >= 0;
}

}  // namespace facemap
