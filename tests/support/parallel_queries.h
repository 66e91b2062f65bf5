#pragma once

#include <facemap/vector.h>

#include "support/oracle.h"
#include "support/scenes.h"

/// Questions for parallel light and parallel rays that sit on the fence. The oracle must have a kept face.
namespace test_queries {

/// Any direction, along an edge, along a line through two vertices, in a face's plane or along an axis.
facemap::Vector make_direction(const oracle::Oracle& oracle, Random& random);

/// A vertex, a point near an edge or a face, or any point of the scene.
facemap::Vector make_point(const test_scenes::TestScene& scene, const oracle::Oracle& oracle, Random& random);

/// Where a ray along d that passes such a point starts: before it, or in it.
facemap::Vector make_ray_origin(const test_scenes::TestScene& scene, const oracle::Oracle& oracle,
                                const facemap::Vector& d, Random& random);

}  // namespace test_queries
