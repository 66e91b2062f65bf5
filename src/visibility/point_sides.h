#pragma once

#include <facemap/vector.h>

#include <cstdint>

#include "parallel/executor.h"
#include "picture/asked_points.h"
#include "picture/unset_vector.h"

namespace facemap {

inline constexpr int kPointSides = 6;

/// For each point the bit of the side, of a cube about the origin, that it is behind.
UnsetVector<std::uint8_t> sides_of_points(const AskedPoints& points, const Vector& origin, const Executor& executor);

}  // namespace facemap
