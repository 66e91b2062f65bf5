#pragma once

#include <facemap/renderer.h>

#include <optional>
#include <string>
#include <vector>

#include "lens_flags.h"

namespace facemap::program {

/// What a user said about the view; the rest is made up.
struct WantedView {
  std::optional<Vector> camera, look_at, up;
  double field_angle = View().field_angle;
  ProjectionKind projection = ProjectionKind::Surface;
  WantedLens lens;
  Size size;  ///< of the picture, for the lens

  bool is_complete() const { return camera && look_at && (!lens.is(LensName::Orthographic) || lens.height); }
};

/// As facemap::complete_view.
View complete_view(const BoundingBall& ball, const Vector& up, const WantedView& wanted);

/// As flags that give the same values again.
std::string flags_of(const View& view);

}  // namespace facemap::program
