#pragma once

#include <facemap/scene.h>

#include "map/cover.h"
#include "map/parallel_faces.h"
#include "map/parallel_frame.h"

namespace facemap {

/// The builder `cover` for maps along a direction: every texel that a face touches, never one too few. A face is the
/// triangle of its corners' map points; its texels are those whose square, grown by the error of map points, it meets
/// (PlaneFace). Faces that begin beyond a texel's cut are left out of it unless `keep_all`; cuts are empty then.
/// Distances are depths (ParallelFrame::depth).
Coverage cover_faces_along(const Scene& scene, const ParallelFrame& frame, const ParallelFaces& faces, bool keep_all);

}  // namespace facemap
