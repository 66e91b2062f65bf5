#pragma once

#include <facemap/counters.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "picture/shadows.h"
#include "scene/closed_parts.h"

namespace facemap {

/// Which lights reach the true points that a picture sees.
struct LitPoints {
  SeenPoints seen;                       ///< masks: bit l set if light l reaches the point
  std::vector<std::uint8_t> dull_masks;  ///< the same for seen.dull, seen.stride bytes each
};

/// Asks every light about every seen point that faces it, the transposed way. Exact. `closed` may be null. `scratch`:
/// one a worker of the executor.
LitPoints find_lit_points(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest, SeenPoints seen,
                          const std::vector<Vector>& lights, const ClosedParts* closed, const Executor& executor,
                          std::vector<ShadowScratch>& scratch, Counters* counters = nullptr);

/// The same, each point asked of each light's lists. One map a light.
LitPoints find_lit_points(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest, SeenPoints seen,
                          const std::vector<PointLight>& lists, const Executor& executor, Counters* counters = nullptr);

/// Float32 points that lie on no face, all of which ask every light: clears bit l of masks[i * stride + l / 8] where
/// light l does not reach positions[i]. `points` holds the same positions. Exact.
void clear_blocked_positions(const Scene& scene, const AskedPoints& points, const std::vector<Vector>& positions,
                             const std::vector<Vector>& lights, std::vector<std::uint8_t>& masks, std::size_t stride,
                             const Executor& executor, std::vector<ShadowScratch>& scratch,
                             Counters* counters = nullptr);
void clear_blocked_positions(const std::vector<Vector>& positions, const std::vector<PointLight>& lists,
                             std::vector<std::uint8_t>& masks, std::size_t stride, const Executor& executor,
                             Counters* counters = nullptr);

}  // namespace facemap
