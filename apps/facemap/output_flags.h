#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "frame_writer.h"
#include "frames.h"
#include "options.h"

namespace facemap::program {

/// What a user said about the files of a run.
struct WantedOutput {
  FrameFiles files;             ///< names that may hold {n} and {model}
  std::filesystem::path scene;  ///< that makes the pictures again; empty: none
  FormatSettings format;
  PlaneSet layers;  ///< planes that the picture's file holds itself

  /// All planes, in files of their own or not.
  PlaneSet planes() const;
};

/// The rows of the table but for -o; they set `output` and `range`, which must outlive them.
std::vector<Option> output_options(WantedOutput& output, std::optional<FrameRange>& range);

/// The files of each frame of `range`, of `all` that there are, known to be writable, to be different ones and to have
/// formats that hold what they shall. Throws UsageError or Error.
std::vector<FrameFiles> check_output_files(const WantedOutput& output, const std::filesystem::path& model,
                                           const FrameRange& range, std::size_t all);

}  // namespace facemap::program
