#pragma once

#include <facemap/vector.h>

#include <vector>

#include "parallel/executor.h"
#include "picture/asked_points.h"

namespace facemap {

/// Finite float32 points as integers about the middle of their box, on no face: fills all of `points` but the samples.
void place_points(const std::vector<Vector>& positions, const Executor& executor, AskedPoints& points);

}  // namespace facemap
