#pragma once

#include <facemap/texture.h>

#include <string_view>

namespace facemap {

/// A texture statement of an MTL file: options, and the file's name, which may have blanks in it. Options stand before
/// the name, or after it as some writers have it.
struct MtlTexture {
  TextureUse use;  ///< without its image
  std::string_view name;
};

/// Reads what follows the keyword; `at` as ObjLines gives it.
MtlTexture read_mtl_texture(const char* at);

}  // namespace facemap
