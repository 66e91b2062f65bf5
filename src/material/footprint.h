#pragma once

#include <facemap/vector.h>

#include "scene/surface_coordinates.h"
#include "scene/texture_place.h"

namespace facemap {

/// A ray of a picture, and the rays through the places one sample to the right and one down.
struct RayBundle {
  Vector through{0}, right{0}, down{0};
};

/// How far texture coordinates move from a sample to its neighbours.
struct Footprint {
  TexturePoint right{0}, down{0};

  /// The same on an image.
  Footprint on(const TexturePlace& place) const { return {place.moved(right), place.moved(down)}; }
};

/// The face's texture coordinates as linear functions of place: `at(move)` is how much they change over it.
class CoordinateGradient {
 public:
  CoordinateGradient() = default;
  CoordinateGradient(const FaceCorners& face, const CornerCoordinates& coordinates);

  TexturePoint at(const DVector& move) const { return {dot(u_, move), dot(v_, move)}; }

 private:
  DVector u_{0}, v_{0};
};

/// The footprint of a ray from K. The neighbouring rays meet the face's plane to first order (Igehy 1999, ray
/// differentials): the same for near rays of any projection, and finite where a neighbour passes the horizon.
Footprint footprint_of(const FaceCorners& face, const CoordinateGradient& gradient, const DVector& K,
                       const RayBundle& rays);

}  // namespace facemap
