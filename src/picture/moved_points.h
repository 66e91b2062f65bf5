#pragma once

#include <facemap/vector.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/asked_points.h"

namespace facemap {

/// Points that the shadow terminator fix (Hanika 2021) lifts off their faces: lights are asked about these float32
/// points instead of the true ones, no facing test.
struct MovedPoints {
  std::vector<std::uint32_t> numbers;  ///< ascending, of the seen points that they stand in for
  std::vector<Vector> positions;       ///< for the exact answer
  std::vector<std::uint32_t> faces;    ///< those that the seen points lie on

  /// The position of one of them by its number.
  const Vector& position_of(std::uint32_t number) const;
};

/// Puts moved points in the place of those that they stand in for: coordinates, and kNoOwnFace for their faces.
/// Makes the step of `points` larger if one does not fit.
void put_in_place(const MovedPoints& moved, const Executor& executor, AskedPoints& points);

/// Gives the points their faces back.
void put_back_faces(const MovedPoints& moved, AskedPoints& points);

}  // namespace facemap
