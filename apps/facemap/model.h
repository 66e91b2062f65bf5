#pragma once

#include <facemap/scene.h>

#include <filesystem>

namespace facemap::program {

/// Loads the scene of a command. Throws UsageError if no model is named, LoadError if it cannot be read.
/// Says on standard error what was odd in the file, unless quiet.
Scene load_model(const std::filesystem::path& path, bool quiet, int threads = 0);

}  // namespace facemap::program
