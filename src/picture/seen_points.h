#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/asked_points.h"
#include "picture/light_places.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"

namespace facemap {

/// The true points that a picture's rays see, ready for clear_blocked.
struct SeenPoints {
  AskedPoints points;                ///< one for each sample that hits a face
  std::vector<std::uint8_t> masks;   ///< stride bytes a point: bit l set if camera and light l are strictly on the same
                                     ///< side of the point's face
  std::size_t stride = 0;            ///< ceil(lights / 8)
  std::vector<std::uint32_t> loose;  ///< ascending numbers of points (not samples), tied or not strictly inside
};

/// `nearest` must be that of `grid`. The same for any number of threads.
SeenPoints find_seen_points(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest,
                            const LightPlaces& lights, const Executor& executor);

}  // namespace facemap
