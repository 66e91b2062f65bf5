#include "picture/ray_table.h"

#include "parallel/executor.h"

namespace facemap {
namespace {

void store(const DVector& v, double out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

}  // namespace

// Rows and columns are in every table, for those who need no more than their numbers.
RayTable::RayTable(const SampleGrid& grid)
    : columns(static_cast<std::size_t>(grid.columns())), rows(static_cast<std::size_t>(grid.rows())) {
  // As Projection::local_from_map.
  for (int i = 0; i < grid.columns(); ++i) {
    columns[static_cast<std::size_t>(i)] = grid.map_point(i, 0).x - grid.lens.width() * 0.5;
  }
  for (int j = 0; j < grid.rows(); ++j) {
    rows[static_cast<std::size_t>(j)] = grid.lens.height() * 0.5 - grid.map_point(0, j).y;
  }
  const Projection* projection = grid.lens.projection();
  if (projection == nullptr) {
    directions = grid.directions ? grid.directions : make_directions(grid, Executor(1));
    return;
  }
  store(grid.frame.axis_x(), frame.axis_x);
  store(grid.frame.axis_y(), frame.axis_y);
  store(grid.frame.axis_z(), frame.axis_z);
  frame.texel_angle = projection->texel_angle();
  frame.is_surface = projection->kind() == ProjectionKind::Surface;
}

void RayTable::find_directions(const std::uint32_t* samples, simd::RayBatch& batch) const {
  if (!directions) {
    simd::ray_directions(frame, batch.map_x, batch.map_y, batch.count, batch.direction[0], batch.direction[1],
                         batch.direction[2]);
    return;
  }
  for (std::size_t i = 0; i < batch.count; ++i) {
    batch.direction[0][i] = directions->x[samples[i]];
    batch.direction[1][i] = directions->y[samples[i]];
    batch.direction[2][i] = directions->z[samples[i]];
  }
}

}  // namespace facemap
