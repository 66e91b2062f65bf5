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

/// Counts the statements of the lines in `text`.
void count(std::string_view text, ObjSizes& sizes) {
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
}

}  // namespace

ObjSizes estimate_sizes(std::string_view text) {
  constexpr std::size_t kSample = 4096, kStep = 8 * kSample;
  ObjSizes sizes;
  std::size_t sampled = 0;
  for (std::size_t at = 0; at < text.size(); at += kStep) {
    const std::string_view sample = text.substr(at, kSample);
    count(sample, sizes);
    sampled += sample.size();
  }
  if (sampled == 0) return sizes;
  constexpr double kSlack = 1.05;  // statements of one kind come in runs, and samples may miss the ends of some
  const double scale = kSlack * static_cast<double>(text.size()) / static_cast<double>(sampled);
  for (std::size_t* const size : {&sizes.vertices, &sizes.texture_coordinates, &sizes.normals, &sizes.triangles}) {
    *size = static_cast<std::size_t>(scale * static_cast<double>(*size));
  }
  return sizes;
}

}  // namespace facemap
