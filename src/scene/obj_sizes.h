#pragma once

#include <cstddef>
#include <string_view>

namespace facemap {

/// How much of each kind an OBJ text seems to hold, from the first letters of lines in samples of it: good for
/// reserving memory, which spares copying arrays as they grow, and for nothing else.
struct ObjSizes {
  std::size_t vertices = 0;
  std::size_t texture_coordinates = 0;
  std::size_t normals = 0;
  std::size_t triangles = 0;
};

ObjSizes estimate_sizes(std::string_view text);

}  // namespace facemap
