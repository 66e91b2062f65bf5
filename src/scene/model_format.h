#pragma once

#include <filesystem>
#include <string_view>

namespace facemap {

enum class ModelFormat { Unknown, Obj, GltfJson, GltfBinary, Ply, StlText, StlBinary };

/// The format of a model's file, by its bytes; `extension` (".obj", in any case, or none: standard input) decides where
/// these do not say: OBJ is any text, and a binary STL file that is cut short looks like nothing.
ModelFormat sniff_format(std::string_view bytes, const std::filesystem::path& extension = {});

/// What sniff_format can tell, for messages: "OBJ, glTF, PLY, STL".
extern const char* const kKnownFormats;

}  // namespace facemap
