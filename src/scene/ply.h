#pragma once

#include <facemap/model.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace facemap {

/// Reads a PLY file, text or binary of either byte order; `name` stands in messages for it. Textures that it names
/// are looked up in `directory`, or nowhere if it is empty.
///
/// Vertices give positions, normals, colours and texture coordinates by the usual names, in any order and of any type;
/// faces are polygons of any size or strips of triangles. What else a file holds is read over.
/// Throws LoadError with the line of a text, or with the element and its number (from 0) of a binary file.
Model read_ply(std::string_view bytes, const std::string& name, const std::filesystem::path& directory,
               const ModelLimits& limits);

}  // namespace facemap
