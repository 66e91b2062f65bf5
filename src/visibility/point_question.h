#pragma once

#include <facemap/scene.h>
#include <facemap/viewpoint.h>

#include <cstdint>
#include <span>

#include "map/face_planes.h"
#include "math/exact_sign.h"

namespace facemap {

/// Which targets are visible from an origin. `visible` becomes 1 or 0 for each.
struct PointQuestion {
  const Scene& faces;  ///< those that may hide something: of the scene's mesh, without holes
  const Vector& origin;
  const Viewpoint::Targets& targets;
  std::span<std::uint8_t> visible;

  std::size_t size() const { return visible.size(); }

  /// Whether a face stands strictly between origin and target. `side` is that towards the origin.
  bool hides(std::uint32_t face, int side, std::size_t target) const {
    return blocks(triangle_of(faces, face), side, origin, GivenPoint{targets.points[target]});
  }
};

}  // namespace facemap
