#include "frame_writer.h"

#include <utility>

#include "pending_files.h"
#include "stopwatch.h"

namespace facemap::program {

double FrameWriter::write_files(const Image& image, const FrameFiles& files, int threads) const {
  Stopwatch time;
  PendingFiles pending;
  const FileFormat format = picture_format(files.picture, settings_);
  pending.add(files.picture, encode_picture(image, format, settings_, layers_, threads));
  for (const auto& [plane, file] : files.planes) {
    pending.add(file, encode_plane(image, plane, plane_format(file, plane), settings_.quality, threads));
  }
  pending.commit();
  return time.lap();
}

void FrameWriter::begin(Image image, const FrameFiles& files) {
  finish();
  frame_ =
      std::async(std::launch::async, [this, image = std::move(image), files] { return write_files(image, files, 1); });
}

void FrameWriter::write(const Image& image, const FrameFiles& files, int threads) {
  finish();
  const double milliseconds = write_files(image, files, threads);
  written_ms_ += milliseconds;
  waited_ms_ += milliseconds;
}

void FrameWriter::finish() {
  if (!frame_.valid()) return;
  Stopwatch time;
  written_ms_ += frame_.get();
  waited_ms_ += time.lap();
}

}  // namespace facemap::program
