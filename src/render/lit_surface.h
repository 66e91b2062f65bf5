#pragma once

#include <facemap/vector.h>

#include "material/material_table.h"
#include "render/surroundings.h"
#include "simd/light_source.h"

namespace facemap {

/// Adds up what a point of a surface sends to the camera.
class LitSurface {
 public:
  /// `position`: of the point.
  LitSurface(const SeenSurface& seen, const SurfaceLook& look, const DVector& position,
             const Surroundings& surroundings);

  /// A light that reaches the point. What stands behind the face's shading normal adds nothing even if the relief is
  /// turned to it: light does not pass through.
  void add(const simd::LightSource& light);

  const DVector& radiance() const { return radiance_; }

 private:
  const SurfaceLook& look_;
  DVector face_normal_, position_, view_;
  DVector radiance_;
};

}  // namespace facemap
