#pragma once

#include "simd/nearest_planes.h"
#include "simd/nearest_target.h"

namespace facemap::simd {

/// Draws faces over their boxes, 16 in lanes, one sample each at a time. For small boxes. What is surely drawn may wait
/// in target.fragments.
void draw_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target);

/// The same, each lane over the spans of its face's rows.
void draw_thin_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target);

/// Draws what waits.
void draw_waiting(const RasterTarget& target);

}  // namespace facemap::simd
