#pragma once

#include <facemap/counters.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "parallel/executor.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "picture/shadows.h"
#include "scene/closed_parts.h"

namespace facemap {

/// What a picture's points ask of all lights at once. Lights are tasks of the executor; each worker has a scratch.
struct LightWork {
  const Scene& scene;
  const std::vector<Vector>& lights;
  const ClosedParts* closed;  ///< or null
  const Executor& executor;
  std::vector<ShadowScratch>& scratch;
  std::function<void(double)> report;  ///< called when a light is done, with the share of lights done; may throw
};

/// Clears bit l of seen.masks where something stands between light l and the point, the transposed way. Exact.
void clear_blocked(const LightWork& work, const SampleGrid& grid, SeenPoints& seen, Counters& counters);

/// The same for float32 points that lie on no face. `points` holds the same positions, rounded.
void clear_blocked(const LightWork& work, const AskedPoints& points, const std::vector<Vector>& positions,
                   std::size_t stride, std::vector<std::uint8_t>& masks, Counters& counters);

/// The same two, each point asked by itself of each light's lists. One map a light.
void clear_blocked_by_lists(const std::vector<PointLight>& lists, const Scene& scene, const SampleGrid& grid,
                            const Executor& executor, SeenPoints& seen, Counters& counters);
void clear_blocked_by_lists(const std::vector<PointLight>& lists, const std::vector<Vector>& positions,
                            std::size_t stride, const Executor& executor, std::vector<std::uint8_t>& masks,
                            Counters& counters);

}  // namespace facemap
