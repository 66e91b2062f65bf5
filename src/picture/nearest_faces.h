#pragma once

#include <facemap/counters.h>
#include <facemap/face.h>
#include <facemap/scene.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "parallel/executor.h"
#include "picture/sample_grid.h"
#include "picture/shared_pages.h"

namespace facemap {

/// What each ray of a picture meets first, as Camera::nearest says it.
struct NearestFaces {
  std::vector<FaceId> faces;         ///< one a sample; kNoFace: none
  std::vector<std::uint32_t> loose;  ///< ascending numbers of the samples whose hit is tied or not strictly inside
  std::shared_ptr<SharedPages> spare = nullptr;  ///< memory that finding them took, for other use, or null
};

/// Draws the faces over all samples at once, the transposed way: no list of faces is made. Exact: the faces and
/// sides are those of Camera::nearest. In `counters`, by_float is the samples that float32 decided; the others count
/// each test of a face.
NearestFaces find_nearest_faces(const Scene& scene, const SampleGrid& grid, const Executor& executor,
                                Counters* counters = nullptr);

}  // namespace facemap
