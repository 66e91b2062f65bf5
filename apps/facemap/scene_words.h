#pragma once

#include <facemap/scene_file.h>

#include <vector>

#include "words.h"

namespace facemap::program {

/// The keys of a scene's [settings] as words. Throws Error with the place of a key that is no option, or one that a
/// file may not set: what names files to write, or loosens limits.
Words setting_words(const SceneFile& scene, const std::filesystem::path& file);

/// What a camera of a scene says, as the words of the options that say the same.
Words camera_words(const SceneCamera& camera, const std::filesystem::path& file);

/// A camera that stands in a model's file as one of a scene.
SceneCamera scene_camera(const ModelCamera& camera);

/// The words that a saved scene keeps in [settings].
bool is_saved(const std::string& name);

}  // namespace facemap::program
