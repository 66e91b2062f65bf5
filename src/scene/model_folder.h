#pragma once

#include <filesystem>
#include <string>

#include "scene/uri.h"

namespace facemap {

/// As find_file, of a name as programs write it: with the path of the machine where the model was made. Of a name
/// that leads out of the folder (absolute, a drive, or with "..") and is not found or not allowed, the last part is
/// looked up beside the model.
UriResult<std::filesystem::path> find_in_folder(const std::filesystem::path& folder, std::string name,
                                                bool allow_outside);

}  // namespace facemap
