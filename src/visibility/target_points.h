#pragma once

#include <facemap/viewpoint.h>

#include "parallel/executor.h"
#include "picture/asked_points.h"

namespace facemap {

/// The targets from `first` up to `last` as lights are asked about them. Throws Error as Viewpoint::visible does.
AskedPoints asked_points(const Scene& scene, const Viewpoint::Targets& targets, std::size_t first, std::size_t last,
                         const Executor& executor);

/// The same by one thread, into memory that was used before.
void put_points(const Scene& scene, const Viewpoint::Targets& targets, std::size_t first, std::size_t last,
                AskedPoints& points);

/// Points without memory of their own yet: `count` of them will stand on large pages.
AskedPoints points_with_room(std::size_t count);

/// Throws Error as Viewpoint::visible does for targets whose sizes differ, and for the tolerance.
void check_targets(const Viewpoint::Targets& targets);

/// The same for each point and face, as asked_points does.
void check_points(const Scene& scene, const Viewpoint::Targets& targets);

}  // namespace facemap
