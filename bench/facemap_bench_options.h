#pragma once

#include <facemap/projection.h>
#include <facemap/renderer.h>

#include <string>
#include <vector>

namespace facemap::bench {

/// What the command line asks for.
struct Options {
  std::vector<std::string> scenes;  ///< names or files; empty: all names of the main table that are there
  int size = 1024;                  ///< pixels a side
  int samples = 1;                  ///< a side of the grid in a pixel
  int lights = 0;                   ///< 0: the scene's own
  int threads = 1;
  int repeat = 7;  ///< interleaved rounds of each kind
  ProjectionKind projection = ProjectionKind::Plane;
  Renderer::Strategy strategy = Renderer::Strategy::Auto;
  bool cpu_time = false;  ///< not the wall clock's: for busy machines, one thread
  bool confirm = false;   ///< ask the lists about every answer that differs
  std::string json;       ///< a file for one JSON object a scene and line; empty: none
};

/// Reads the command line. Prints and exits for --help and for mistakes.
Options read_options(int argc, char** argv);

}  // namespace facemap::bench
