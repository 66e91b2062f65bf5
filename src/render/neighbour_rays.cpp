#include "render/neighbour_rays.h"

#include <cmath>
#include <optional>

#include "math/elementary.h"

namespace facemap {
namespace {

Vector ray_through(const SpaceVector& frame, const Lens& lens, const MapPoint& point, const Vector& otherwise) {
  const std::optional<DVector> local = lens.direction(point);
  return local ? Vector(frame.world_from_local(*local)) : otherwise;
}

// The way to a neighbour: forwards, unless a border of pieces lies between.
double way(double place, double step, int piece) {
  return std::floor(place / piece) == std::floor((place + step) / piece) ? step : -step;
}

}  // namespace

void set_neighbours(const SpaceVector& frame, const Lens& lens, const MapPoint& point, double step, RayBundle& rays) {
  double right = step, down = step;
  if (lens.projection() == nullptr) {
    right = way(point.x, step, lens.piece_width());
    down = way(point.y, step, lens.piece_height());
  }
  rays.right = ray_through(frame, lens, {point.x + right, point.y}, rays.through);
  rays.down = ray_through(frame, lens, {point.x, point.y + down}, rays.through);
}

// The operations of Projection::local_from_map on the neighbours' map points.
NeighbourRays::NeighbourRays(const SampleGrid& grid)
    : grid_(grid), columns_(static_cast<std::size_t>(grid.columns())), rows_(static_cast<std::size_t>(grid.rows())) {
  const double step = 1.0 / grid.per_side;
  for (int i = 0; i < grid.columns(); ++i) {
    columns_[static_cast<std::size_t>(i)] = (grid.map_point(i, 0).x + step) - grid.lens.width() * 0.5;
  }
  for (int j = 0; j < grid.rows(); ++j) {
    rows_[static_cast<std::size_t>(j)] = grid.lens.height() * 0.5 - (grid.map_point(0, j).y + step);
  }
}

void NeighbourRays::find(const simd::RayFrame& frame, const std::uint32_t* samples, const simd::RayBatch& batch) {
  samples_ = samples;
  if (grid_.lens.projection() == nullptr) return;
  const auto columns = static_cast<std::uint32_t>(columns_.size());
  for (std::size_t i = 0; i < batch.count; ++i) places_[i] = columns_[samples[i] % columns];
  find(frame, places_, batch.map_y, batch.count, right_, has_right_);
  for (std::size_t i = 0; i < batch.count; ++i) places_[i] = rows_[samples[i] / columns];
  find(frame, batch.map_x, places_, batch.count, down_, has_down_);
}

// The kernel takes any map point; whether there is a direction is as Projection::has_direction has it.
void NeighbourRays::find(const simd::RayFrame& frame, const double* x, const double* y, std::size_t count,
                         float (&rays)[3][simd::kSeenBatch], bool (&has_ray)[simd::kSeenBatch]) const {
  simd::ray_directions(frame, x, y, count, rays[0], rays[1], rays[2]);
  for (std::size_t i = 0; i < count; ++i) {
    has_ray[i] = !frame.is_surface || std::sqrt(x[i] * x[i] + y[i] * y[i]) * frame.texel_angle <= elementary::kPi;
  }
}

RayBundle NeighbourRays::bundle(const simd::RayBatch& batch, std::size_t i) const {
  const auto at = [i](const float(&rays)[3][simd::kSeenBatch]) { return Vector(rays[0][i], rays[1][i], rays[2][i]); };
  const Vector through = at(batch.direction);
  if (grid_.lens.projection() == nullptr) {
    RayBundle rays{through};
    const auto columns = static_cast<std::uint32_t>(columns_.size());
    const MapPoint place =
        grid_.map_point(static_cast<int>(samples_[i] % columns), static_cast<int>(samples_[i] / columns));
    set_neighbours(grid_.frame, grid_.lens, place, 1.0 / grid_.per_side, rays);
    return rays;
  }
  return {through, has_right_[i] ? at(right_) : through, has_down_[i] ? at(down_) : through};
}

}  // namespace facemap
