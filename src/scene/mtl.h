#pragma once

#include <facemap/material.h>

#include <string_view>
#include <vector>

#include "scene/obj_warnings.h"

namespace facemap {

/// Reads MTL text and appends its materials. What cannot be read keeps its default, with a warning; statements
/// that Material has no place for are read over.
void parse_mtl(std::string_view text, ObjWarnings& warnings, std::vector<Material>& materials);

}  // namespace facemap
