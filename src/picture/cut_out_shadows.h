#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <memory>
#include <vector>

#include "parallel/executor.h"
#include "picture/light_places.h"
#include "picture/moved_points.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "scene/cut_outs.h"

namespace facemap {

/// Clears bit l of seen.masks where a face with holes stands between light l, which has a place, and the point, and is
/// there where the light meets it. Points ask lists of these faces alone; lists of few lights are held at a time.
/// Exact. Moved points have been put in their places (put_in_place).
void clear_blocked_by_cut_outs(const Scene& scene, const std::shared_ptr<const CutOuts>& cut_outs,
                               const LightPlaces& lights, const SampleGrid& grid, const Executor& executor,
                               const MovedPoints& moved, SeenPoints& seen, Counters& counters);

}  // namespace facemap
