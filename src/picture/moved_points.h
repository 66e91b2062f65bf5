#pragma once

#include <facemap/vector.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/asked_points.h"
#include "picture/seen_points.h"

namespace facemap {

/// Points that the shadow terminator fix (Hanika 2021) lifts off their faces: float32 points of no face, which the
/// lights behind the face are asked about. They stand behind the seen points in the list of those that are asked.
struct MovedPoints {
  std::vector<std::uint32_t> numbers;  ///< ascending, their own among the asked points
  std::vector<std::uint32_t> owners;   ///< ascending, of the seen points that they are lifted from
  std::vector<Vector> positions;       ///< for the exact answer

  /// The position of one of them by its number.
  const Vector& position_of(std::uint32_t number) const;
};

/// Adds places for the moved points behind the seen ones, and numbers them; owners and positions are there. They have
/// their owners' samples and faces, until put_in_place.
void add_places(MovedPoints& moved, SeenPoints& seen);

/// Puts moved points in their places: coordinates, and kNoOwnFace for their faces. Makes the step of `points` larger if
/// one does not fit.
void put_in_place(const MovedPoints& moved, const Executor& executor, AskedPoints& points);

/// Gives the owners the lights that reach the moved points, and takes away the places.
void give_back(const MovedPoints& moved, SeenPoints& seen);

}  // namespace facemap
