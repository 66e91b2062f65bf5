#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "map/light_lists.h"
#include "parallel/executor.h"
#include "picture/kept_bounds.h"
#include "picture/light_places.h"
#include "picture/moved_points.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "picture/shadows.h"
#include "scene/closed_parts.h"

namespace facemap {

/// What a picture's points ask of all lights at once. Lights are tasks of the executor; each worker has a scratch.
struct LightWork {
  const Scene& scene;
  const LightPlaces& lights;
  const ClosedParts* closed;  ///< or null
  KeptBounds* bounds;         ///< or null
  const Executor& executor;
  std::vector<ShadowScratch>& scratch;
  std::function<void(double)> report;  ///< called when a light is done, with the share of lights done; may throw
};

/// Clears bit l of seen.masks where something stands between light l and the point, the transposed way, for each light
/// that has a place. Exact. Moved
/// points have been put in their places (put_in_place); with closed parts, seen.loose has those of find_hidden_points.
void clear_blocked(const LightWork& work, const SampleGrid& grid, const MovedPoints& moved, SeenPoints& seen,
                   Counters& counters);

/// The same, each point asked by itself of the lists of each light that has some: one pointer a light, or null.
void clear_blocked_by_lists(const std::vector<const LightLists*>& lists, const Scene& scene, const SampleGrid& grid,
                            const Executor& executor, const MovedPoints& moved, SeenPoints& seen, Counters& counters);

}  // namespace facemap
