#pragma once

#include <vector>

#include "input.h"

namespace facemap::program {

/// Throws UsageError for models that a scene file cannot name.
void check_names(const Input& input);

/// The scene that makes the same pictures again: models and ground as they were, these views and lights, and as
/// settings the words that shape pictures.
SceneFile scene_of(const Input& input, const Loaded& loaded, const RenderArguments& arguments,
                   const std::vector<View>& views, const std::vector<Light>& lights);

/// Writes it, and says if reading it again will need --allow-outside.
void save_scene(const SceneFile& scene, const std::filesystem::path& file);

}  // namespace facemap::program
