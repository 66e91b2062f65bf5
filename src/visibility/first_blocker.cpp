#include "visibility/first_blocker.h"

#include <cmath>

#include "map/face_planes.h"
#include "math/dvector.h"

namespace facemap {

FirstBlocker::FirstBlocker(const Scene& scene, const Vector& origin, const Vector& point)
    : scene_(scene), O_(origin), P_(point), length_(length(DVector(point) - DVector(origin))) {}

void FirstBlocker::meet(std::uint32_t id, int side) {
  const auto face = static_cast<FaceId>(id);
  const Triangle corners = triangle_of(scene_, id);
  const Tracked share = segment_parameter(corners, O_, P_);
  if (face_ != kNoFace) {
    int order = (share - share_).sign();
    if (order != 1 && order != -1) order = compare_depth_towards(corners, side, corners_, side_, O_, P_);
    // Of those at the same distance the one turned towards the origin, then the lower id.
    if (order == 0) order = side != side_ ? side - side_ : face - face_;
    if (order > 0) return;
  }
  face_ = face;
  side_ = side;
  corners_ = corners;
  share_ = share;
}

double FirstBlocker::reach() const {
  return face_ == kNoFace ? HUGE_VAL : (share_.value + share_.error) * length_ * (1 + 0x1p-40);
}

}  // namespace facemap
