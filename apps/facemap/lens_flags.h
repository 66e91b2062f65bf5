#pragma once

#include <facemap/lens.h>
#include <facemap/renderer.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "text_values.h"

namespace facemap::program {

enum class LensName { Surface, Plane, Orthographic, Equirect, Cube, OpenCV, OpenCVFisheye };

/// R and t, row by row, as ViewPlace::of_opencv has them.
using OpenCVPose = std::array<std::array<double, 4>, 3>;

/// What a user said about the lens, and of an OpenCV camera's place.
struct WantedLens {
  std::optional<LensName> name;
  std::optional<CubeLayout> layout;
  std::optional<CameraMatrix> matrix;
  std::optional<std::vector<double>> distortion;
  std::optional<OpenCVPose> pose;
  std::optional<double> height;  ///< of an orthographic picture, world units

  bool is(LensName wanted) const { return name == wanted; }

  /// Where a field angle says how wide it is.
  bool has_field_angle() const { return !name || is(LensName::Surface) || is(LensName::Plane); }
};

/// Rows of the table; they set `lens`, which must outlive them.
std::vector<Option> lens_options(WantedLens& lens);

/// Throws UsageError, naming both, for flags that do not go together, and for what a lens must be told.
void check(const WantedLens& lens);

/// The same of --ortho-height, once it is known which lens the camera has.
void check_height(const WantedLens& lens);

/// The picture's size if none is given.
Size made_up_size(const WantedLens& lens);

/// Gives the view its lens for pictures of that size. Throws UsageError if it can have none, Error for values out of
/// range.
void set_lens(const WantedLens& lens, const Size& size, View& view);

}  // namespace facemap::program
