#pragma once

#include <filesystem>
#include <string>

namespace facemap {

/// Finds the file that a model names below the folder it lies in. Files elsewhere are not opened at the word of a
/// model: of a name that leads out (absolute, a drive, or with ".."), the last part is looked up beside the model, and
/// symbolic links out of the folder are not followed. Returns why there is none, or nothing; `folder` may be empty:
/// nowhere.
std::string find_in_folder(const std::filesystem::path& folder, const std::string& name, std::filesystem::path& found);

}  // namespace facemap
