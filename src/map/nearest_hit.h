#pragma once

#include <facemap/camera.h>
#include <facemap/scene.h>

#include "math/exact_sign.h"

namespace facemap {

/// The nearest of the faces that a ray meets, by exact comparison: what Camera::nearest promises, whoever asks.
class NearestHit {
 public:
  NearestHit(const Scene& scene, const Vector& origin, const Vector& direction, Counters* counters);

  /// A face that the ray meets, `side` its side from the origin. In any order, each once.
  void meet(std::uint32_t face, int side, bool strictly_inside);

  /// Upper bound of the distance to the nearest hit, world units.
  double reach() const;

  /// The nearest hit so far, without its depth.
  const Camera::Hit& hit() const { return hit_; }

  Camera::Hit with_depth() const;

 private:
  int compare(const Tracked& t, const Triangle& face, int side) const;

  const Scene& scene_;
  Vector O_, d_;
  double length_;
  Counters* counters_;
  Camera::Hit hit_;
  Tracked t_;
  Triangle face_{};
};

}  // namespace facemap
