#pragma once

#include <facemap/projection.h>
#include <facemap/space_vector.h>

namespace facemap {

/// The fixed rays of a picture, or of some rows of it: per_side x per_side samples in each pixel, numbered row by row.
/// Each ray's direction is a float32 vector and exact input from there on.
struct SampleGrid {
  SpaceVector frame;  ///< position and axes of the camera
  Projection projection;
  int per_side = 1;
  int first_row = 0;  ///< of the picture's rows of samples: the grid begins here
  int row_count = 0;  ///< rows of the grid; 0: to the picture's end

  int columns() const { return projection.width() * per_side; }
  int rows_of_picture() const { return projection.height() * per_side; }
  int rows() const { return row_count > 0 ? row_count : rows_of_picture() - first_row; }
  std::size_t count() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }

  /// `row` counts from the grid's first.
  MapPoint map_point(int column, int grid_row) const {
    const int row = first_row + grid_row;
    return {column / per_side + (column % per_side + 0.5) / per_side,
            row / per_side + (row % per_side + 0.5) / per_side};
  }

  /// As Camera::direction_through; the zero vector where the projection has no direction.
  Vector direction(int column, int row) const {
    const MapPoint point = map_point(column, row);
    if (!projection.has_direction(point)) return Vector(0);
    return Vector(frame.world_from_local(projection.local_from_map(point)));
  }
};

}  // namespace facemap
