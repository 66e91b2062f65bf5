#pragma once

#include <facemap/model.h>
#include <facemap/renderer.h>
#include <facemap/vector.h>

#include <array>
#include <optional>

namespace facemap {

/// Where a camera stands, as far as somebody has said it.
struct ViewPlace {
  std::optional<Vector> position, look_at, up;
  std::optional<double> height;  ///< of an orthographic picture, world units

  /// The place of a camera as OpenCV has it: R|t row by row, camera = R world + t, x to the right, y down, z ahead.
  static ViewPlace of_opencv(const std::array<std::array<double, 4>, 3>& pose);
};

/// A whole view of what is in `ball`, through the lens of `lens`. A position alone looks at the ball's centre; a point
/// to look at alone is seen from the direction that a made-up view has; neither: the whole ball is in sight. Without an
/// up of its own it has the world's, or for a sight along that another.
View complete_view(const BoundingBall& ball, const Vector& world_up, const ViewPlace& place, const View& lens);

}  // namespace facemap
