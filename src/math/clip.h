#pragma once

#include <facemap/vector.h>

#include <span>
#include <vector>

namespace facemap {

/// Keeps the part of a convex polygon where z >= near; local axes, z along the sight. The plane itself is kept.
/// `clipped` is replaced; it is empty if nothing lies in front. Two faces with a common edge get the same new
/// vertex on it, bit for bit.
void clip_at_near_plane(std::span<const DVector> polygon, double near, std::vector<DVector>& clipped);

}  // namespace facemap
