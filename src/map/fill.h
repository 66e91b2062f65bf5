#pragma once

#include <facemap/projection.h>
#include <facemap/scene.h>
#include <facemap/space_vector.h>

#include <vector>

#include "map/texel_entry.h"

namespace facemap {

/// The builder as published: appends, for each kept face in ascending order, the texels of the raster that hold a
/// point of its edge curves and those whose centres lie between the curves, ascending, each once.
/// Wang 2022, sec. 4.2.2, 4.2.3.
///
/// It reproduces the paper's method and pictures. It is not exact: a texel that an edge clips between two points of
/// its curve can miss the face. src/map/cover.h misses none.
///
/// Seen edge-on (frame.position() on the face's plane): no texel; such a face is hit by nothing.
/// Around the sight axis: nothing special, the curve surrounds the centre.
/// Around the antipode: the face's image lies outside its curve, up to the rim, and that is filled.
/// An edge across the antipode has no curve; the face is turned by less than 2^-15 texel so that it has one.
/// Plane projection: the part behind the camera is clipped off. Parts outside the raster are clipped.
void fill_faces(const Scene& scene, const SpaceVector& frame, const Projection& projection,
                std::vector<TexelEntry>& entries);

}  // namespace facemap
