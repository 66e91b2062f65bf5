#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include "parallel/executor.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"

namespace facemap {

/// find_nearest_faces for any lens: faces find the tiles of samples that they may reach through a tree of caps, and
/// each tile is drawn by itself on a plane of its own.
NearestFaces draw_lens_view(const Scene& scene, const SampleGrid& grid, const Executor& executor, Counters* counters);

}  // namespace facemap
