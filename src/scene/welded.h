#pragma once

#include <facemap/mesh.h>

#include <cstdint>
#include <vector>

namespace facemap {

/// The corners with each position replaced by the first one of its value; `welded` is empty if all differ.
inline Corners welded_corners(const Corners& corners, const std::vector<std::uint32_t>& welded) {
  if (welded.empty()) return corners;
  return {welded[corners[0]], welded[corners[1]], welded[corners[2]]};
}

inline bool repeats_vertex(const Corners& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

}  // namespace facemap
