#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "view_flags.h"

namespace facemap::program {

/// What a user said about the views of one or more pictures.
struct WantedFrames {
  std::vector<Vector> cameras, look_ats, ups;
  std::vector<double> field_angles;
  ProjectionKind projection = ProjectionKind::Surface;
  int turntable = 0;  ///< pictures; 0: not wanted

  /// One a camera; the other lists have no value, one for all cameras or one for each, else UsageError.
  std::vector<WantedView> each() const;

  /// How many pictures there will be. Throws as above.
  std::size_t count() const;
};

/// All views, completed. A turntable's first is the given one.
std::vector<View> complete_views(const Scene& scene, const WantedFrames& wanted);

/// A file's name for each of `count` frames: {n} becomes the frame's number from 0, with leading zeros to the width of
/// the count. Throws UsageError if several frames would have the same name.
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& name, std::size_t count);

}  // namespace facemap::program
