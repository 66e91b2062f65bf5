#pragma once

#include <facemap/image.h>

#include <filesystem>
#include <future>

namespace facemap::program {

/// Where a frame goes; an empty plane is not wanted.
struct FrameFiles {
  std::filesystem::path picture;  ///< - is standard output
  std::filesystem::path ids, depths, lights;
};

/// Writes frames while the next ones are being made. A frame's files appear together: a signal waits for the last.
class FrameWriter {
 public:
  FrameWriter() = default;
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
  std::future<double> frame_;  ///< the one being written; gives its milliseconds
  double waited_ms_ = 0, written_ms_ = 0;
};

}  // namespace facemap::program
