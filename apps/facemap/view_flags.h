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

/// A whole view. A camera alone looks at the scene's centre; a point to look at alone is seen from the
/// direction that a made-up view has; neither: the whole scene is in sight. Without `up`, +y, or +z for a sight along
/// it.
View complete_view(const Scene& scene, const WantedView& wanted);

/// As flags that give the same values again.
std::string flags_of(const View& view);

}  // namespace facemap::program
