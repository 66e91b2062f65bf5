#pragma once

#include <facemap/model.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/model_format.h"

namespace facemap {

/// Reads a model of a format that sniff_format told, but for OBJ, which has a reader of its own for large files.
/// `name` stands in messages for it; files that it names are looked up in `directory`. Throws LoadError.
Model read_model(ModelFormat format, std::string_view bytes, const std::string& name,
                 const std::filesystem::path& directory, const ModelLimits& limits);

}  // namespace facemap
