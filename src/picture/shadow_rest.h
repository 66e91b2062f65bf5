#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "picture/asked_points.h"
#include "picture/shadows.h"

namespace facemap {

/// Which of `asked` some face blocks, for points that have no place on a raster: almost at the light, as a rule. Each
/// face near the way from the light to the points is held against each of them.
std::vector<std::uint32_t> find_blocked_singly(const Scene& scene, const Vector& light, const AskedPoints& points,
                                               const std::vector<std::uint32_t>& asked,
                                               const BlocksExactly& blocks_exactly, Counters* counters);

}  // namespace facemap
