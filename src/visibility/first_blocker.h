#pragma once

#include <facemap/face.h>
#include <facemap/scene.h>

#include <cstdint>

#include "math/exact_sign.h"

namespace facemap {

/// The first of the faces that stand between an origin and a point, by exact comparison: what Viewpoint::blocked_by
/// promises.
class FirstBlocker {
 public:
  FirstBlocker(const Scene& scene, const Vector& origin, const Vector& point);

  /// A face that stands strictly between, `side` its side from the origin. In any order, each once.
  void meet(std::uint32_t face, int side);

  /// The first so far.
  FaceId face() const { return face_; }

  /// Upper bound of the distance to it from the origin, world units; infinite if there is none.
  double reach() const;

 private:
  const Scene& scene_;
  Vector O_, P_;
  double length_;
  FaceId face_ = kNoFace;
  int side_ = 0;
  Triangle corners_{};
  Tracked share_;  // of the way to the point
};

}  // namespace facemap
