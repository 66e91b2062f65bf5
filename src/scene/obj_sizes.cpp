#include "scene/obj_sizes.h"

#include <algorithm>
#include <cstring>

namespace facemap {

namespace {

/// Triangles of a face of as many corners as there are blanks in its line.
std::size_t count_triangles(const char* line, const char* end) {
  const std::ptrdiff_t blanks = std::count(line, end, ' ');
  return blanks > 2 ? static_cast<std::size_t>(blanks - 2) : 0;
}

}  // namespace

ObjSizes estimate_sizes(std::string_view text) {
  ObjSizes sizes;
  const char* line = text.data();
  const char* const end = line + text.size();
  while (end - line > 2) {
    const auto* newline = static_cast<const char*>(std::memchr(line, '\n', static_cast<std::size_t>(end - line)));
    const char* const line_end = newline == nullptr ? end : newline;
    if (line[0] == 'v') {
      sizes.vertices += line[1] == ' ';
      sizes.texture_coordinates += line[1] == 't';
      sizes.normals += line[1] == 'n';
    } else if (line[0] == 'f') {
      sizes.triangles += count_triangles(line, line_end);
    }
    line = newline == nullptr ? end : newline + 1;
  }
  return sizes;
}

}  // namespace facemap
