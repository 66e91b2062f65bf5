#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include "parallel/executor.h"
#include "picture/nearest_faces.h"
#include "picture/nearest_view.h"
#include "picture/sample_grid.h"

namespace facemap {

/// find_nearest_faces for a view that plane_view gives: all faces drawn into one raster of inverse depths.
NearestFaces draw_plane_view(const Scene& scene, const SampleGrid& grid, const PlaneView& view,
                             const Executor& executor, Counters* counters);

}  // namespace facemap
