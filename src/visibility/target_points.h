#pragma once

#include <facemap/viewpoint.h>

#include "parallel/executor.h"
#include "picture/asked_points.h"

namespace facemap {

/// The targets from `first` up to `last` as lights are asked about them. Throws Error as Viewpoint::visible does.
AskedPoints asked_points(const Scene& scene, const Viewpoint::Targets& targets, std::size_t first, std::size_t last,
                         const Executor& executor);

}  // namespace facemap
