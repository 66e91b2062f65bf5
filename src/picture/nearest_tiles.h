#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include "parallel/executor.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"

namespace facemap {

/// find_nearest_faces for surface projections: faces are dealt to tiles of samples, each of which is drawn by itself.
NearestFaces draw_surface_view(const Scene& scene, const SampleGrid& grid, const Executor& executor,
                               Counters* counters);

}  // namespace facemap
