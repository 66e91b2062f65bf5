#pragma once

#include <facemap/lens.h>
#include <facemap/space_vector.h>

#include <cstdint>
#include <vector>

#include "material/footprint.h"
#include "picture/sample_grid.h"
#include "simd/seen_planes.h"
#include "simd/seen_rays.h"

namespace facemap {

/// Sets the rays through the places `step` pixels to the right of a map point and below it; the ray itself where there
/// is no direction. Where a lens's piece ends before, the places to the left and above serve as well. `rays.through`
/// must be set.
void set_neighbours(const SpaceVector& frame, const Lens& lens, const MapPoint& point, double step, RayBundle& rays);

/// The same for samples of a grid, many at a time, bit for bit.
class NeighbourRays {
 public:
  explicit NeighbourRays(const SampleGrid& grid);

  /// The rays of a batch, as RayTable::frame and the map places of its samples have them: fills right and down.
  /// `samples` and the batch must stay until bundles are asked.
  void find(const simd::RayFrame& frame, const std::uint32_t* samples, const simd::RayBatch& batch);

  /// The rays of sample i of the batch.
  RayBundle bundle(const simd::RayBatch& batch, std::size_t i) const;

 private:
  void find(const simd::RayFrame& frame, const double* x, const double* y, std::size_t count,
            float (&rays)[3][simd::kSeenBatch], bool (&has_ray)[simd::kSeenBatch]) const;

  const SampleGrid& grid_;
  const std::uint32_t* samples_ = nullptr;
  std::vector<double> columns_, rows_;  // of neighbours, as in RayTable; of projections
  double places_[simd::kSeenBatch];
  float right_[3][simd::kSeenBatch], down_[3][simd::kSeenBatch];
  bool has_right_[simd::kSeenBatch], has_down_[simd::kSeenBatch];
};

}  // namespace facemap
