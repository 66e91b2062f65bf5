#pragma once

#include <filesystem>
#include <string>

namespace facemap::program {

/// The -o of `facemap MODEL`: the model's name with .png, in the current folder. Throws Error if a file of this
/// name is there that this program did not write: models have textures of their own names.
std::string default_output(const std::filesystem::path& model);

}  // namespace facemap::program
