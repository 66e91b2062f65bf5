#pragma once

#include <facemap/lens.h>
#include <facemap/space_vector.h>

#include <memory>

#include "picture/direction_table.h"

namespace facemap {

/// The fixed rays of a picture, or of a rectangle of it: per_side x per_side samples in each pixel, numbered row by
/// row. Each ray's direction is a float32 vector and exact input from there on.
struct SampleGrid {
  SpaceVector frame;  ///< position and axes of the camera
  Lens lens;          ///< of the whole picture
  int per_side = 1;
  int first_row = 0;     ///< of the picture's rows of samples: the grid begins here
  int row_count = 0;     ///< rows of the grid; 0: to the picture's end
  int first_column = 0;  ///< the same for columns
  int column_count = 0;
  std::shared_ptr<const DirectionTable> directions = nullptr;  ///< of the grid's samples, or null: computed when asked

  int columns_of_picture() const { return lens.width() * per_side; }
  int rows_of_picture() const { return lens.height() * per_side; }
  int columns() const { return column_count > 0 ? column_count : columns_of_picture() - first_column; }
  int rows() const { return row_count > 0 ? row_count : rows_of_picture() - first_row; }
  std::size_t count() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }

  /// Place in the whole picture. `grid_column` and `grid_row` count from the grid's first.
  MapPoint map_point(int grid_column, int grid_row) const {
    const int column = first_column + grid_column, row = first_row + grid_row;
    return {column / per_side + (column % per_side + 0.5) / per_side,
            row / per_side + (row % per_side + 0.5) / per_side};
  }

  /// As Camera::direction_through; the zero vector where the lens has no direction.
  Vector direction_through(const MapPoint& place) const {
    const std::optional<DVector> local = lens.direction(place);
    return local ? Vector(frame.world_from_local(*local)) : Vector(0);
  }

  Vector direction(int column, int row) const {
    if (!directions) return direction_through(map_point(column, row));
    return directions->at(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) +
                          static_cast<std::size_t>(column));
  }
};

}  // namespace facemap
