#pragma once

#include <facemap/renderer.h>

#include <string>

namespace facemap::program {

/// What a run took. Times in milliseconds.
struct Stats {
  std::string model;
  double load_ms = 0, total_ms = 0;
  double write_ms = 0;  ///< of all pictures, in part while the next one was made
  double wait_ms = 0;   ///< in which nothing else was done
  int width = 0, height = 0;
  std::size_t light_count = 0, frame_count = 0;
  Renderer::Statistics frames;  ///< sums of times and counts; the largest memory; the last frame's way

  void add_frame(const Renderer::Statistics& frame);
};

/// All of it as one JSON object and a newline.
std::string stats_json(const Stats& stats, const Scene& scene);

/// The same as lines "name  value".
std::string stats_text(const Stats& stats, const Scene& scene);

}  // namespace facemap::program
