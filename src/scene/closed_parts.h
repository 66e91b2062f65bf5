#pragma once

#include <facemap/vector.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

class Scene;

/// The connected parts of a scene whose surface is closed for certain: directed edges cancel, vertices welded by
/// position, over the kept faces and those without area. For such a part, seen from outside, only the faces turned away
/// from a light need be asked (docs/algorithm.md).
class ClosedParts {
 public:
  ClosedParts(const Scene& scene, const Executor& executor);

  bool any() const noexcept { return closed_count_ > 0; }
  std::size_t closed_count() const noexcept { return closed_count_; }

  /// One byte a face: 1 where the face belongs to a closed part about which both points have winding number 0
  /// for certain. Empty if there is none.
  std::vector<std::uint8_t> skippable_entries(const Scene& scene, const Vector& camera, const Vector& light) const;

 private:
  std::size_t closed_count_ = 0;
};

}  // namespace facemap
