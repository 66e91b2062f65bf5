#pragma once

#include <facemap/face.h>
#include <facemap/vector.h>

#include <array>

namespace facemap {

/// The point in which the ray origin + t direction (t > 0) meets the plane of a face that it hits: the true,
/// rational point, not a rounded one. What a Camera sees and a PointLight is asked about.
struct SurfacePoint {
  Vector origin{0};                  ///< a camera's position
  Vector direction{0};               ///< of the ray, any length
  std::array<Vector, 3> vertices{};  ///< of the face that is seen
  FaceId face = kNoFace;             ///< its id, skipped when asking; kNoFace: it is not in the map's scene
  int side = 0;                      ///< sign of det(vertices - origin), -1 or 1: which side of the face is seen
};

}  // namespace facemap
