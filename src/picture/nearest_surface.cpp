#include "picture/nearest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/cover.h"
#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/elementary.h"
#include "picture/nearest_view.h"

namespace facemap {
namespace {

constexpr double kFloatHalfUlp = 0x1p-24;

// A tile's samples lie within this of each other (radians, along a side), so that its plane is little bent.
constexpr double kLargestTileAngle = 0.25;

// Vertices beyond this angle from the axis have no point: the map's scale grows without bound towards 180 degrees.
// Within the view it reaches this much farther than its corners, for faces that stand half outside.
constexpr double kLargestPointAngle = 2.6, kPointMargin = 0.25;

// Edges longer than this (radians) have no box; all of an edge is within half of it of one of its ends.
constexpr double kLongestEdge = 0.5;

// Views whose corners are within this of the axis get a pyramid that faces behind it and beside it are dropped by.
constexpr double kLargestPyramidAngle = 1.4;

// An angle that stands for the error of a vertex's direction (10 roundings) and of a ray's (1), by the map's stretch;
// and for roundings of the angle and of (u, v) themselves.
constexpr double kDirectionRoundings = 12 * kFloatHalfUlp, kPointRoundings = 8 * kFloatHalfUlp;

// The map's centre is at 0; in texels, as Projection has them. Points without a direction are drawn to the rim.
DVector centre_direction(const SampleGrid& grid, const SurfaceTile& tile) {
  const Projection& projection = *grid.lens.projection();
  double x = (grid.first_column + tile.first_column + tile.columns * 0.5) / grid.per_side - projection.width() * 0.5;
  double y = (grid.first_row + tile.first_row + tile.rows * 0.5) / grid.per_side - projection.height() * 0.5;
  const double largest = elementary::kPi / projection.texel_angle() * (1 - 0x1p-40), r = std::sqrt(x * x + y * y);
  if (r > largest) {
    x *= largest / r;
    y *= largest / r;
  }
  return projection.local_from_map({x + projection.width() * 0.5, y + projection.height() * 0.5});
}

}  // namespace

SurfaceView::SurfaceView(const Scene& scene, const SampleGrid& grid) {
  const double half_columns = grid.columns_of_picture() * 0.5, half_rows = grid.rows_of_picture() * 0.5;
  sample_angle = grid.lens.projection()->texel_angle() / grid.per_side;
  const double f = 1 / sample_angle;
  const SpaceVector& frame = grid.frame;
  unit = unit_for(length(scene.centre() - DVector(frame.position())) + scene.bounding_radius());

  const double corner = std::sqrt(half_columns * half_columns + half_rows * half_rows) * sample_angle;
  const double largest_angle = std::min(kLargestPointAngle, corner + kPointMargin);
  const double farthest = largest_angle + kLongestEdge / 2;  // of any point of an edge
  const double stretch = farthest > 0.01 ? farthest / elementary::sin(farthest) : 1.01;

  directions.shift = 0;
  simd::PlaneFrame rows;
  set_axes(frame.axis_x(), -frame.axis_y(), frame.axis_z(), f, unit, rows);
  set_axes(frame.axis_x(), -frame.axis_y(), frame.axis_z(), 1, unit, directions);
  set_errors(1, 1, 0, directions);
  simd::VertexFrame& v = vertices.frame;
  for (int i = 0; i < 3; ++i) {
    directions.origin[i] = frame.position()[i];
    v.origin[i] = frame.position()[i];
    for (int j = 0; j < 3; ++j) v.rows[i][j] = static_cast<float>(rows.rows[i][j]);
  }
  v.unit = static_cast<float>(unit);
  v.limit = 0;
  vertices.per_radian = static_cast<float>(f);
  vertices.largest_angle = static_cast<float>(largest_angle);

  // Comparisons with an infinite slack are false: no pyramid.
  const bool has_pyramid = corner < kLargestPyramidAngle;
  const double edge = has_pyramid ? elementary::tan(corner) * f * (1 + 0x1p-10) + 1 : 1;
  v.edge_u = v.edge_v = static_cast<float>(edge);
  constexpr float kNever = std::numeric_limits<float>::infinity();
  v.slack_u = v.slack_v = has_pyramid ? float_above(16 * kFloatHalfUlp * (f + edge)) : kNever;
  v.slack_z = has_pyramid ? float_above(16 * kFloatHalfUlp) : kNever;

  boxes.first_column = static_cast<float>(grid.first_column + 0.5 - half_columns);
  boxes.first_row = static_cast<float>(grid.first_row + 0.5 - half_rows);
  const double angle_error = kDirectionRoundings * stretch + kPointRoundings * farthest + simd::kAngleError;
  boxes.margin =
      float_above(angle_error * f + 16 * kFloatHalfUlp * (half_columns + half_rows + farthest * f) + 0x1p-20);
  boxes.edge_u = boxes.edge_v = kNever;
  boxes.columns = grid.columns();
  boxes.rows = grid.rows();
  boxes.bulge = float_above(bulge(1, farthest) * sample_angle * (1 + 0x1p-6));
  boxes.longest_squared = static_cast<float>(kLongestEdge * kLongestEdge * f * f * (1 - 0x1p-6));

  while (tile_side < TilePlane::kLargestTile && 2 * tile_side * sample_angle <= kLargestTileAngle) tile_side *= 2;
  const int blocks = std::max(1, tile_side / simd::kBlockSide);
  row_samples = static_cast<std::uint32_t>(blocks) * simd::kBlockSamples;
  tile_columns = (grid.columns() + tile_side - 1) / tile_side;
  tile_rows = (grid.rows() + tile_side - 1) / tile_side;
}

SurfaceTile tile_of(const SurfaceView& view, const SampleGrid& grid, std::size_t tile) {
  const auto columns = static_cast<std::size_t>(view.tile_columns);
  const int x = static_cast<int>(tile % columns) * view.tile_side,
            y = static_cast<int>(tile / columns) * view.tile_side;
  SurfaceTile t;
  static_cast<TileArea&>(t) = {x, y, std::min(view.tile_side, grid.columns() - x),
                               std::min(view.tile_side, grid.rows() - y)};
  const double half_columns = grid.columns_of_picture() * 0.5, half_rows = grid.rows_of_picture() * 0.5;
  const double rim = elementary::kPi / view.sample_angle, slack = 1;  // samples
  const double u0 = grid.first_column + x - half_columns, u1 = u0 + t.columns, v0 = grid.first_row + y - half_rows,
               v1 = v0 + t.rows;
  const auto length = [](double u, double v) { return std::sqrt(u * u + v * v); };
  t.is_whole = length(std::max(-u0, u1), std::max(-v0, v1)) + slack < rim;
  t.is_empty = length(std::max({u0, -u1, 0.0}), std::max({v0, -v1, 0.0})) - slack > rim;
  return t;
}

// Samples in batches; those beyond the tile repeat its last row and column.
void set_plane(const SurfaceView& view, const SampleGrid& grid, const RayTable& rays, const SurfaceTile& tile,
               TilePlane& plane) {
  const DVector middle = normalized(grid.frame.world_from_local(centre_direction(grid, tile)));
  plane.look_along(middle, 1 / view.sample_angle, view.unit, grid.frame.position());
  double columns[simd::kSeenBatch], rows[simd::kSeenBatch];
  float x[simd::kSeenBatch], y[simd::kSeenBatch], z[simd::kSeenBatch];
  const std::size_t all = view.samples();
  for (std::size_t first = 0; first < all; first += simd::kSeenBatch) {
    const std::size_t count = std::min(simd::kSeenBatch, all - first);
    for (std::size_t i = 0; i < count; ++i) {
      const auto sample = static_cast<std::uint32_t>(first + i);
      const int column = std::min(simd::column_of(view.row_samples, sample), tile.columns - 1);
      const int row = std::min(simd::row_of(view.row_samples, sample), tile.rows - 1);
      columns[i] = rays.columns[static_cast<std::size_t>(tile.first_column + column)];
      rows[i] = rays.rows[static_cast<std::size_t>(tile.first_row + row)];
    }
    simd::ray_directions(rays.frame, columns, rows, count, x, y, z);
    plane.set_points(x, y, z, first, count);
  }
  plane.set_errors();
  if (tile.is_whole) return;
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; ++column) {
      const MapPoint point = grid.map_point(tile.first_column + column, tile.first_row + row);
      if (grid.lens.projection()->has_direction(point)) continue;
      const std::uint32_t i = simd::sample_at(view.row_samples, column, row);
      plane.u[i] = plane.v[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
}

SurfaceCaps::SurfaceCaps(const SurfaceView& view, const SampleGrid& grid)
    : count_(static_cast<std::size_t>(view.tile_columns) * static_cast<std::size_t>(view.tile_rows)) {
  const std::size_t room = count_ + simd::kBlockFaces;
  x_.resize(room);
  y_.resize(room);
  z_.resize(room);
  sine_.resize(room);
  for (std::size_t i = 0; i < count_; ++i) {
    const SurfaceTile tile = tile_of(view, grid, i);
    const DVector c = centre_direction(grid, tile);
    x_[i] = static_cast<float>(c.x);
    y_[i] = static_cast<float>(-c.y);
    z_[i] = static_cast<float>(c.z);
    // No two points of the map are nearer on it than their directions are on the sphere.
    const double half_diagonal = std::sqrt(double(tile.columns) * tile.columns + double(tile.rows) * tile.rows) / 2;
    const double radius = (half_diagonal * view.sample_angle + 2 * kFloatHalfUlp) * (1 + 0x1p-20);
    sine_[i] = radius < elementary::kPi / 2 ? float_above(elementary::sin(radius)) : 2.0f;
  }
}

}  // namespace facemap
