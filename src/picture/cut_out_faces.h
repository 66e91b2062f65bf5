#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <memory>

#include "parallel/executor.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"
#include "scene/cut_outs.h"

namespace facemap {

/// `nearest` is what the rays of the grid meet of the scene's solid faces; makes it what they meet of all. Rays ask a
/// camera's map of the faces with holes, one after the other: those are few, or there is no other way to skip them.
void add_cut_outs(const Scene& scene, const std::shared_ptr<const CutOuts>& cut_outs, const SampleGrid& grid,
                  const Executor& executor, NearestFaces& nearest, Counters* counters);

}  // namespace facemap
