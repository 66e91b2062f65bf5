#pragma once

#include <facemap/vector.h>

#include <optional>

#include "math/exact_sign.h"

namespace facemap {

/// A ray from a point, whose signed crossings with the faces of a closed part sum to the part's winding number about
/// the point: exact signs, behind tests that most faces fail.
class WindingRay {
 public:
  static constexpr int kDirections = 3;

  /// The ray leads away from `centre`; `direction` is one of 0..kDirections-1.
  WindingRay(const Vector& from, const DVector& centre, int direction);

  /// -1, 0 or 1, for a face with an area. Nothing if the ray meets an edge or a vertex, lies in the face's plane and
  /// meets the face, or starts on the face: then another ray must be tried.
  std::optional<int> crossing(const Triangle& face) const;

 private:
  bool may_meet(const Triangle& face) const;
  bool surely_passes(const Triangle& face, int first, int second) const;

  Vector from_, along_;
};

}  // namespace facemap
