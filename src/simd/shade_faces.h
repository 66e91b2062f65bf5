#pragma once

#include "simd/seen_planes.h"

namespace facemap::simd {

/// What shading needs of the faces of a PlaneBatch beside their planes.
struct ShadedFaces {
  double corners[9][kSeenBatch];      ///< a.x, a.y, a.z, b.x, ...
  double side[kSeenBatch];            ///< s about the camera, -1 or 1; 0 if doubles can't tell
  float file_normals[9][kSeenBatch];  ///< at the corners, as the file has them
  double towards[3][kSeenBatch];      ///< the face's unit normal, towards the camera
  double normals[9][kSeenBatch];      ///< at the corners, of unit length, turned to the camera's side together
  double is_smooth[kSeenBatch];       ///< 1 if all corners have normals, else 0
  double largest[kSeenBatch];         ///< largest coordinate of a corner
};

/// Fills corners and side. `planes` must have been set up.
void place_corners(const PlaneBatch& planes, ShadedFaces& faces);

/// Fills the rest from side and file_normals, of which the latter may be left out unless `smooth`.
void orient_faces(const PlaneBatch& planes, bool smooth, ShadedFaces& faces);

}  // namespace facemap::simd
