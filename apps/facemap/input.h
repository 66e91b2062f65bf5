#pragma once

#include <facemap/scene.h>
#include <facemap/scene_file.h>

#include <string>

#include "render_arguments.h"
#include "words.h"

namespace facemap::program {

/// What MODEL named: a scene file, or a model as a scene of one.
struct Input {
  SceneFile scene;
  Words settings;         ///< of a scene file
  bool is_scene = false;  ///< a scene file
  std::string bytes;      ///< the model itself, if it came from standard input
};

bool is_standard_input(const std::filesystem::path& path);

/// Reads standard input to its end. Throws LoadError if there are more than `max_bytes`.
std::string read_standard_input(std::uint64_t max_bytes);

/// Opens what `path` names; "-" is standard input. Throws LoadError or Error.
Input read_input(const std::filesystem::path& path, const ModelLimits& limits);

/// Whether a ground is to be added.
bool wants_ground(const Input& input, const RenderArguments& arguments);

/// What is drawn.
struct Loaded {
  Scene scene;
  BoundingBall ball;   ///< of the models, without the ground
  Vector up{0, 1, 0};  ///< the scene's
  Words words;         ///< those given, and those that the studio added
};

/// Loads the models, and adds what options ask for: a scale, a ground, the studio. `words` are those of the command
/// line and of the scene's settings. Throws LoadError or Error.
Loaded load(const Input& input, const Words& words);

}  // namespace facemap::program
