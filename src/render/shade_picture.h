#pragma once

#include <facemap/renderer.h>

#include <cstdint>
#include <span>
#include <vector>

#include "parallel/executor.h"
#include "picture/asked_points.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"

namespace facemap {

/// Points that the shadow terminator fix (Hanika 2021) lifts off their faces: lights are asked about these float32
/// points instead of the true ones, all faces, no facing test.
struct MovedPoints {
  AskedPoints points;                 ///< their `faces` are kNoOwnFace
  std::vector<Vector> positions;      ///< the float32 points themselves, for the exact answer
  std::vector<std::uint32_t> owners;  ///< ascending numbers of the seen points that they stand for
  std::vector<std::uint8_t> masks;    ///< seen.stride bytes a point, a bit set for each light that is to be asked
};

/// Finds them among the seen points, and clears the masks of their owners, which need not be asked. Unless light masks
/// are wanted for themselves, lights that the shading normal is turned from are left out: they add nothing. None with
/// flat normals or without the fix. Throws Error if a moved point is not finite.
MovedPoints find_moved_points(const Scene& scene, const SampleGrid& grid, SeenPoints& seen,
                              const std::vector<Light>& lights, const Renderer::Options& options,
                              const Executor& executor);

/// Puts the masks of moved points, once lights have been asked, in the place of their owners' masks.
void put_back_masks(const MovedPoints& moved, SeenPoints& seen);

/// Writes colors[sample] for the samples of all seen points, as Shader::shade computes it, bit for bit, from masks that
/// say which lights are lit. Other elements of `colors` (one a sample of the grid) stay as they are.
void shade_points(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen, const std::vector<Light>& lights,
                  const Renderer::Options& options, const Executor& executor, std::span<Color> colors);

}  // namespace facemap
