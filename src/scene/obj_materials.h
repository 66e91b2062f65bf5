#pragma once

#include <facemap/material.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/image_table.h"
#include "scene/obj_warnings.h"

namespace facemap {

/// The materials of an OBJ file: names that faces use, and the MTL files that define them, in either order.
class ObjMaterials {
 public:
  /// MTL files are looked up in `directory` and its folders, or not at all if it is empty; none of more than
  /// `max_bytes` is read. Textures that they name lie there too, unless others are allowed.
  ObjMaterials(const std::filesystem::path& directory, std::uint64_t max_bytes, bool allow_outside);

  /// usemtl: a number for the name. The empty name is kNoIndex, no material.
  std::uint32_t use(std::string_view name, std::int64_t line);

  /// mtllib: reads the files that are named.
  void read_libraries(std::string_view names, std::int64_t line, ObjWarnings& warnings);

  /// Turns numbers of names (one a triangle) into indices of materials(); kNoIndex where a name is not defined.
  /// Empties `numbers` if nothing else is left.
  void resolve(std::vector<std::uint32_t>& numbers, ObjWarnings& warnings) const;

  std::vector<Material>& materials() { return materials_; }
  std::vector<TextureImage>& images() { return images_.images(); }

  /// What is odd about the MTL files.
  const std::vector<std::string>& warnings() const { return mtl_warnings_; }

 private:
  struct Use {
    std::uint32_t number;
    std::int64_t first_line;
  };

  void read_library(const std::string& name, std::int64_t line, ObjWarnings& warnings);

  std::filesystem::path directory_;
  std::uint64_t max_bytes_;
  std::map<std::string, Use, std::less<>> uses_;
  std::set<std::string> libraries_;  ///< tried so far
  std::vector<Material> materials_;
  ImageTable images_;
  std::vector<std::string> mtl_warnings_;
};

/// The file names of an mtllib statement. Blanks part names, and may stand within them: a name goes on until a
/// word ends in ".mtl" (if none does, each word is a name), and "\ " is a blank of a name. Other backslashes
/// become slashes.
std::vector<std::string> split_library_names(std::string_view names);

}  // namespace facemap
