#pragma once

#include <facemap/material.h>

#include <filesystem>
#include <string_view>
#include <vector>

#include "scene/image_table.h"
#include "scene/obj_warnings.h"

namespace facemap {

/// Reads MTL text and appends its materials; textures are looked up from `folder` on, where the text comes from. What
/// cannot be read keeps its default, with a warning; statements that Material has no place for are read over.
void parse_mtl(std::string_view text, const std::filesystem::path& folder, ImageTable& images, ObjWarnings& warnings,
               std::vector<Material>& materials);

}  // namespace facemap
