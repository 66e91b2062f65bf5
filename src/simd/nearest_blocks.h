#pragma once

#include <cstddef>

#include "simd/nearest_planes.h"
#include "simd/nearest_target.h"

namespace facemap::simd {

/// Draws faces over their boxes, one after the other, the samples of a block in lanes.
void draw_wide_faces(const FaceBlock& block, const FaceBoxes& boxes, const RasterTarget& target);

/// Draws one face over a box. `first_u`, `first_v`: the centre of sample (0, 0).
void draw_large(const LargeFace& face, std::uint32_t id, const SampleBox& box, double first_u, double first_v,
                const RasterTarget& target);

/// Copies the face ids of the target's rows, -1 where there is none: `columns` of each row, whose places in `faces` are
/// `stride` apart; row 0 is the first there.
void copy_rows(const RasterTarget& target, std::size_t columns, std::int32_t* faces, std::size_t stride);

}  // namespace facemap::simd
