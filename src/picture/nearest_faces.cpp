#include "picture/nearest_faces.h"

#include <facemap/camera.h>

#include "picture/nearest_lens.h"
#include "picture/nearest_raster.h"
#include "picture/nearest_tiles.h"
#include "picture/nearest_view.h"
#include "picture/wide_map.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr std::size_t kLeastSamples = 1 << 12;  // of a task

// The paper's way, one ray after the other.
NearestFaces ask_lists(const Scene& scene, const SampleGrid& grid, const Executor& executor, Counters* counters) {
  const Camera camera(scene, grid.frame, wide_map(grid.lens));

  NearestFaces nearest;
  nearest.faces.resize(grid.count());
  const auto columns = static_cast<std::size_t>(grid.columns());
  std::vector<std::uint8_t> is_loose(grid.count());
  std::vector<Counters> counts(static_cast<std::size_t>(executor.threads()));
  for_ranges(executor, grid.count(), kLeastSamples, [&](std::size_t first, std::size_t last, int worker) {
    for (std::size_t i = first; i < last; ++i) {
      const Vector direction = grid.direction(static_cast<int>(i % columns), static_cast<int>(i / columns));
      const Camera::Hit hit = camera.nearest(direction, &counts[static_cast<std::size_t>(worker)]);
      nearest.faces[i] = hit.face;
      is_loose[i] = hit && (hit.tied || !hit.strictly_inside);
    }
  });
  for (std::size_t i = 0; i < is_loose.size(); ++i) {
    if (is_loose[i]) nearest.loose.push_back(static_cast<std::uint32_t>(i));
  }
  for (const Counters& count : counts) {
    if (counters != nullptr) *counters += count;
  }
  return nearest;
}

}  // namespace

NearestFaces find_nearest_faces(const Scene& scene, const SampleGrid& grid, const Executor& executor,
                                Counters* counters) {
  const FloatingPointMode mode;
  const Projection* projection = grid.lens.projection();
  if (projection == nullptr) return draw_lens_view(scene, grid, executor, counters);
  if (const std::optional<PlaneView> view = plane_view(scene, grid)) {
    return draw_plane_view(scene, grid, *view, executor, counters);
  }
  if (projection->kind() == ProjectionKind::Surface) return draw_surface_view(scene, grid, executor, counters);
  return ask_lists(scene, grid, executor, counters);
}

}  // namespace facemap
