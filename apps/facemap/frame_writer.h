#pragma once

#include <facemap/image.h>

#include <filesystem>
#include <future>
#include <vector>

#include "file_format.h"

namespace facemap::program {

struct PlaneFile {
  Plane plane;
  std::filesystem::path file;
};

/// Where a frame goes; - is standard output.
struct FrameFiles {
  std::filesystem::path picture;
  std::vector<PlaneFile> planes;
};

/// Writes frames while the next ones are being made. A frame's files appear together, when all are complete.
class FrameWriter {
 public:
  /// `layers`: planes that the pictures hold themselves.
  FrameWriter(const FormatSettings& settings, PlaneSet layers) : settings_(settings), layers_(layers) {}
  ~FrameWriter() = default;  ///< waits
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Waits for the frame before, whose failure it throws, and begins to write this one on a thread of its own.
  void begin(Image image, const FrameFiles& files);

  /// The same, but writes this one on so many threads and returns when it is done.
  void write(const Image& image, const FrameFiles& files, int threads);

  /// Waits for the last frame and throws its failure.
  void finish();

  /// Milliseconds that begin(), write() and finish() waited, and those that the writing itself took.
  double waited_ms() const noexcept { return waited_ms_; }
  double written_ms() const noexcept { return written_ms_; }

 private:
  double write_files(const Image& image, const FrameFiles& files, int threads) const;

  FormatSettings settings_;
  PlaneSet layers_;
  std::future<double> frame_;  ///< the one being written; gives its milliseconds
  double waited_ms_ = 0, written_ms_ = 0;
};

}  // namespace facemap::program
