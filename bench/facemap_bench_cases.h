#pragma once

#include <facemap/renderer.h>
#include <facemap/scene.h>

#include <string>
#include <vector>

#include "facemap_bench_options.h"

namespace facemap::bench {

/// A scene with what looks at it and what lights it.
struct Case {
  std::string name;
  Scene scene;
  double scene_ms;  ///< what making the Scene from the mesh took
  View view;
  View turned;  ///< the camera gone 5 degrees about the point it looks at
  std::vector<Light> lights;
};

/// The seven scenes of the main table, the models only if their files are there.
std::vector<std::string> default_case_names();

/// Makes the case called `name`. Throws Error.
///   chessboard, grass, bust, typewriter  generated, with their own camera and lights; NAME@D at detail D
///   models/chessboard, models/copperBeech, models/nefertiti  made-up view and lights
///   rooms/hotel_room   camera and three lights inside
///   rooms/chessboard   the generated one, eight lights one unit above the board
///   FILE               made-up view and lights
Case make_case(const std::string& name, const Options& options);

}  // namespace facemap::bench
