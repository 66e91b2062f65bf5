#include "frame_writer.h"

#include <utility>

#include "interrupt.h"
#include "output.h"
#include "stopwatch.h"

namespace facemap::program {
namespace {

double write_files(const Image& image, const FrameFiles& files, int threads) {
  Stopwatch time;
  if (is_standard_output(files.picture))
    write_to_standard_output(encode_png(image, threads));  // a pipe may never take it
  write_whole([&] {
    if (!is_standard_output(files.picture)) write_png(image, files.picture, threads);
    if (!files.ids.empty()) write_ids_npy(image, files.ids);
    if (!files.depths.empty()) write_depths_npy(image, files.depths);
    if (!files.lights.empty()) write_lights_npy(image, files.lights);
  });
  return time.lap();
}

}  // namespace

void FrameWriter::begin(Image image, const FrameFiles& files) {
  finish();
  frame_ = std::async(std::launch::async, [image = std::move(image), files] { return write_files(image, files, 1); });
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
