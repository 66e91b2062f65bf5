#pragma once

#include <facemap/vector.h>

#include <vector>

#include "picture/asked_points.h"

namespace facemap {

/// Finite float32 points as integers about the middle of their box; on no face. Their samples are left out.
AskedPoints place_points(const std::vector<Vector>& positions);

}  // namespace facemap
