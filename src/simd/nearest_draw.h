#pragma once

#include "simd/nearest_planes.h"
#include "simd/nearest_target.h"

namespace facemap::simd {

/// Draws faces over their boxes, 16 in lanes, one sample each at a time. For small boxes.
void draw_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target);

/// The same, each lane over the spans of its face's rows.
void draw_thin_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target);

/// The same, one face after the other, neighbouring samples of a row in lanes.
void draw_wide_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target);

/// Draws one face over a box, row by row. `first_u`, `first_v`: the centre of sample (0, 0).
void draw_large(const LargeFace& face, std::uint32_t id, const SampleBox& box, double first_u, double first_v,
                const RasterTarget& target);

}  // namespace facemap::simd
