#pragma once

#include <facemap/renderer.h>

#include <string>

namespace facemap::program {

/// What a render took.
struct RunFacts {
  std::string model;
  double load_ms = 0, write_ms = 0, total_ms = 0;
  int width = 0, height = 0;
  std::size_t light_count = 0;
};

/// All of it as one JSON object and a newline. Times in milliseconds, memory in bytes.
std::string stats_json(const RunFacts& facts, const Scene& scene, const Renderer::Statistics& statistics);

}  // namespace facemap::program
