#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/shadow_frame.h"

namespace facemap::simd {

/// (u, v, w) of vertices, three floats each; NaN where a vertex has no place (kShadowSteepest and the like). w < 0 is
/// behind the light. `positions` are three floats each; room for `count` + 16 vertices.
void project_vertices(const ShadowFrame& frame, const float* positions, std::size_t count, float* places);

/// For each cell of texels (kCellColumns x kCellRows) the least w of its points, and for the cells of each further
/// level, four of the level below; +infinity where there is no point.
struct FarthestPyramid {
  static constexpr int kLevels = 12;
  static constexpr int kCellColumnsLog2 = 3;
  static constexpr int kCellRowsLog2 = 2;

  const float* cells;
  int levels;
  std::int32_t first[16];    ///< where a level begins in `cells`
  std::int32_t columns[16];  ///< cells in a row of a level
};

/// What is known of the faces' triangles on the raster.
struct FacesToSift {
  const std::uint32_t* corners;      ///< three a face
  const float* places;               ///< of project_vertices
  const std::uint8_t* skip_entries;  ///< one a face, or null
  std::size_t first, last;           ///< faces to look at; at most kShadowFaces
  ShadowRaster raster;
  const FarthestPyramid* farthest;
};

inline constexpr std::size_t kShadowFaces = 1024;

/// Faces that may block some point, with the texels they may do it in. Room for 16 more than are looked at.
struct SiftedFaces {
  std::uint32_t face[kShadowFaces + 16];
  std::int32_t columns[kShadowFaces + 16];  ///< first | last << 16
  std::int32_t rows[kShadowFaces + 16];     ///< first | last << 16
  float nearest[kShadowFaces + 16];         ///< upper bound of w
  std::size_t count = 0;

  /// Faces with a corner behind the light or without a place: only their three planes say where they are.
  std::uint32_t odd[kShadowFaces + 16];
  std::size_t odd_count = 0;
};

/// Leaves out faces that are off the raster, behind the light, behind all points or where there is none, and those of
/// skip_entries that are surely turned towards the light.
void sift_faces(const FacesToSift& from, SiftedFaces& to);

}  // namespace facemap::simd
