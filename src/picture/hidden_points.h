#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "picture/asked_points.h"
#include "picture/moved_points.h"
#include "picture/shadows.h"

namespace facemap {

/// The numbers of those moved points, put in place in `points`, that the camera does not see, or that may touch a face
/// that it does not see edge-on. For the others entry faces of closed parts may be left out (docs/algorithm.md).
std::vector<std::uint32_t> find_hidden_points(const Scene& scene, const Vector& camera, const AskedPoints& points,
                                              const MovedPoints& moved, ShadowScratch& scratch, Counters& counters);

}  // namespace facemap
