#pragma once

#include <facemap/point_light.h>

namespace facemap {

/// Where a light's map aims: at the middle of the scene.
DVector sight_of_light(const Scene& scene, const Vector& position);

/// The projection of a light's map: of all faces of the scene, as the frame sees them, unless the options say
/// otherwise. Throws Error for options out of range and for a field too narrow for the scene.
Projection light_projection(const Scene& scene, const SpaceVector& frame, const PointLight::Options& options);

}  // namespace facemap
