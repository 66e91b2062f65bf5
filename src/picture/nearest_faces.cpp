#include "picture/nearest_faces.h"

#include <facemap/camera.h>

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "picture/nearest_lens.h"
#include "picture/nearest_raster.h"
#include "picture/nearest_tiles.h"
#include "picture/nearest_view.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr std::size_t kLeastSamples = 1 << 12;  // of a task
constexpr int kLargestMap = 1024;               // texels a side

// A map wide enough for all rays of a plane projection: one that rounding to float32 moves past the picture's border is
// asked all the same.
Camera::Options wide_enough(const Projection& projection) {
  const double half_width = projection.width() * 0.5 * projection.texel_angle();
  const double half_height = projection.height() * 0.5 * projection.texel_angle();
  const double corner = elementary::atan2(std::sqrt(half_width * half_width + half_height * half_height), 1);
  constexpr double kRoundedDirection = 0x1p-22;  // radians; components are off by 2^-24
  Camera::Options options;
  options.projection = ProjectionKind::Surface;
  options.field_angle = std::min(2 * elementary::kPi, 2 * (corner * (1 + 0x1p-10) + kRoundedDirection));
  options.width = options.height = std::clamp(std::max(projection.width(), projection.height()), 1, kLargestMap);
  return options;
}

// The paper's way, one ray after the other.
NearestFaces ask_lists(const Scene& scene, const SampleGrid& grid, const Executor& executor, Counters* counters) {
  const Camera camera(scene, grid.frame, wide_enough(*grid.lens.projection()));

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
