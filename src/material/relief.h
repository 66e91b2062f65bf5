#pragma once

#include <facemap/vector.h>

#include "scene/surface_coordinates.h"

namespace facemap {

/// The directions on a face in which an image goes to the right and up, from the places of its corners (x to the right,
/// y down). Zero where corners share places: there is no relief.
struct ImageAxes {
  DVector right{0}, up{0};

  ImageAxes(const FaceCorners& face, const TexturePoint (&places)[3]);
};

/// The normal that a map asks for: x to the right in the image, y up, z along the unit `normal`, which is on the
/// camera's side. `is_behind`: the camera sees the face from behind, where what sticks out in front goes in.
DVector tilted(const DVector& normal, const ImageAxes& axes, const DVector& local, bool is_behind);

}  // namespace facemap
