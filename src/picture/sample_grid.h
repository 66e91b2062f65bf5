#pragma once

#include <facemap/projection.h>
#include <facemap/space_vector.h>

namespace facemap {

/// The fixed rays of a picture: per_side x per_side samples in each pixel, numbered row by row over the whole picture.
/// Each ray's direction is a float32 vector and exact input from there on.
struct SampleGrid {
  SpaceVector frame;  ///< position and axes of the camera
  Projection projection;
  int per_side = 1;

  int columns() const { return projection.width() * per_side; }
  int rows() const { return projection.height() * per_side; }
  std::size_t count() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }

  MapPoint map_point(int column, int row) const {
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
