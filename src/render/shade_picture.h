#pragma once

#include <facemap/renderer.h>

#include <cstdint>
#include <span>
#include <vector>

#include "material/material_table.h"
#include "parallel/executor.h"
#include "picture/moved_points.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"

namespace facemap {

/// Finds the points that the shadow terminator fix lifts among the seen ones, and adds them behind these, with masks of
/// the lights that are to be asked about them: those that are not strictly before their face. Unless light masks are
/// wanted for themselves, lights that the shading normal is turned from are left out for both: they add nothing. Those
/// without a light are left out. None with flat normals or without the fix. Throws Error if one is not finite.
MovedPoints find_moved_points(const Scene& scene, const SampleGrid& grid, SeenPoints& seen,
                              const std::vector<Light>& lights, const Renderer::Options& options,
                              const Executor& executor);

/// Clears the bits of lights whose cone or range does not hold a point: they are not asked about it. Before moved
/// points are put in place, and after they are found: the position of the point that they stand in for counts.
void clear_unreached(const Scene& scene, const SampleGrid& grid, SeenPoints& seen, const std::vector<Light>& lights,
                     const Executor& executor);

/// Writes colors[sample] for the samples of all seen points, as Shader::shade computes it, bit for bit, from masks that
/// say which lights are lit. Other elements of `colors` (one a sample of the grid) stay as they are. Without materials
/// (null) all is white.
void shade_points(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen, const std::vector<Light>& lights,
                  const Renderer::Options& options, const Executor& executor, std::span<Color> colors,
                  const MaterialTable* materials = nullptr);

/// Colours and lights of the seen points, in their order.
struct PointLooks {
  std::vector<Color> colors;
  std::vector<std::uint8_t> masks;  ///< theirs, without the lights that the shading normal is turned from
};

/// The same colours, and which lights add to them.
PointLooks look_at_points(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen,
                          const std::vector<Light>& lights, const Renderer::Options& options, const Executor& executor,
                          const MaterialTable* materials = nullptr);

}  // namespace facemap
