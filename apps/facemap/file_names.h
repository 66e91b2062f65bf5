#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace facemap::program {

inline constexpr int kMaxFrames = 100'000;  ///< pictures of a run

/// Pictures first..last of 0..count-1: those of a run that one command makes.
struct FrameRange {
  std::size_t first = 0, last = 0;
};

/// "7", "0-9" or "0..9"; both ends count. Throws UsageError.
FrameRange parse_frame_range(const std::string& text);

/// Names of files that hold something for each picture: {n} stands for its number from 0, with leading zeros to the
/// width of the count, {n:04} for four digits or more, {model} for the model's name without folder and extension.
/// `all`: how many pictures there are in all. Throws UsageError for another name in braces, and if several pictures of
/// `range` would have the same name.
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& pattern, const std::filesystem::path& model,
                                               std::size_t all, const FrameRange& range);

}  // namespace facemap::program
