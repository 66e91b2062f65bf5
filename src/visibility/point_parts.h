#pragma once

#include <facemap/vector.h>

#include <cstddef>
#include <cstdint>

#include "parallel/executor.h"
#include "picture/asked_points.h"
#include "picture/unset_vector.h"

namespace facemap {

/// At most so many parts: each has a bit.
inline constexpr int kMostPointParts = 8;

/// Points that tasks share so that those in about the same direction from an origin come to the same task: then few
/// faces concern two of them.
struct PointParts {
  int count = 1;
  UnsetVector<std::uint8_t> bits;  ///< one byte a point: the bit of its part
};

/// `wanted`: how many parts of about the same size, 2 to kMostPointParts. Points on all sides of the origin are shared
/// out by the sides of a cube about it, six.
PointParts share_points(const AskedPoints& points, const Vector& origin, int wanted, const Executor& executor);

}  // namespace facemap
