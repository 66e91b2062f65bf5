#pragma once

#include <optional>
#include <vector>

#include "file_names.h"
#include "view_flags.h"

namespace facemap::program {

/// What a user said about the views of one or more pictures.
struct WantedFrames {
  std::vector<Vector> cameras, look_ats, ups;
  std::vector<double> field_angles;
  std::optional<ProjectionKind> projection;
  WantedLens lens;
  int turntable = 0;                ///< pictures; 0: not wanted
  std::optional<FrameRange> range;  ///< which of them; all if it is not said

  /// One a camera; the other lists have no value, one for all cameras or one for each, else UsageError. So it is for
  /// flags that do not go with the lens.
  std::vector<WantedView> each() const;

  /// How many pictures there are. Throws as above.
  std::size_t count() const;

  /// Which of `all` pictures are to be made. Throws UsageError if there are not so many.
  FrameRange selected(std::size_t all) const;
};

/// All views, completed, for pictures of that size. A turntable's first is the given one; with one there must be one
/// view alone, else UsageError.
std::vector<View> complete_views(const BoundingBall& ball, const Vector& up, const std::vector<WantedView>& wanted,
                                 int turntable, const Size& size);

}  // namespace facemap::program
