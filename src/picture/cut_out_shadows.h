#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <memory>
#include <vector>

#include "map/light_lists.h"
#include "parallel/executor.h"
#include "picture/light_places.h"
#include "picture/moved_points.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "scene/cut_outs.h"

namespace facemap {

/// Lists of faces with holes that are kept for the next picture: those of the first lights, up to a limit.
struct KeptCutOutLists {
  static constexpr std::size_t kMostBytes = std::size_t{1} << 28;

  ListsOfLights of_lights;  ///< one a light, null where it is not kept; empty before the first picture
  std::size_t bytes = 0;
};

/// Clears bit l of seen.masks where a face with holes stands between light l, which has a place, and the point, and is
/// there where the light meets it. Points ask lists of these faces alone; lists of few lights are held at a time.
/// Exact. Moved points have been put in their places (put_in_place).
void clear_blocked_by_cut_outs(const Scene& scene, const std::shared_ptr<const CutOuts>& cut_outs,
                               const LightPlaces& lights, const SampleGrid& grid, const Executor& executor,
                               const MovedPoints& moved, KeptCutOutLists* kept, SeenPoints& seen, Counters& counters);

}  // namespace facemap
