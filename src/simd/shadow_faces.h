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
  const std::uint8_t* occupied;  ///< one bit a spot, rows of whole bytes, readable for 4 bytes more; or null
};

inline constexpr std::size_t kShadowFaces = 1024;

/// Faces that may block some point, with the texels they may do it in.
struct SiftedFaces {
  /// For those that wait, those that are looked at, sixteen more that vectors reach.
  static constexpr std::size_t kRoom = 2 * kShadowFaces + 32;

  std::uint32_t face[kRoom];
  std::int32_t columns[kRoom];  ///< first | last << 16
  std::int32_t rows[kRoom];     ///< first | last << 16
  float nearest[kRoom];         ///< upper bound of w
  std::size_t count = 0;

  /// Faces that cross the plane Z = 0 through the light, or have a corner without a place.
  std::uint32_t across[kShadowFaces + 16];
  std::size_t across_count = 0;
};

/// Appends faces to `to`, and replaces to.across. Leaves out faces that are off the raster, behind the light, behind
/// all points or where there is none, and those of skip_entries that are surely turned towards the light.
void sift_faces(const FacesToSift& from, SiftedFaces& to);

}  // namespace facemap::simd
