#include "picture/ray_table.h"

namespace facemap {
namespace {

void store(const DVector& v, double out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

}  // namespace

RayTable::RayTable(const SampleGrid& grid)
    : columns(static_cast<std::size_t>(grid.columns())), rows(static_cast<std::size_t>(grid.rows())) {
  store(grid.frame.axis_x(), frame.axis_x);
  store(grid.frame.axis_y(), frame.axis_y);
  store(grid.frame.axis_z(), frame.axis_z);
  frame.texel_angle = grid.projection.texel_angle();
  frame.is_surface = grid.projection.kind() == ProjectionKind::Surface;
  // As Projection::local_from_map.
  for (int i = 0; i < grid.columns(); ++i) {
    columns[static_cast<std::size_t>(i)] = grid.map_point(i, 0).x - grid.projection.width() * 0.5;
  }
  for (int j = 0; j < grid.rows(); ++j) {
    rows[static_cast<std::size_t>(j)] = grid.projection.height() * 0.5 - grid.map_point(0, j).y;
  }
}

}  // namespace facemap
