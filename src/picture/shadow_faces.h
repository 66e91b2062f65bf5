#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "picture/shadow_points.h"
#include "picture/shadows.h"
#include "simd/given_pairs.h"

namespace facemap {

/// What the faces of a scene are held against, about one light.
struct ShadowRun {
  const Scene& scene;
  const Vector& light;
  const simd::ShadowFrame& frame;
  double slack;  ///< of set_up_planes
  const std::uint8_t* skip_entries;
  const std::vector<std::uint32_t>* some;  ///< the only faces that matter, or null
  const float* given;                      ///< AskedPoints::given
  const BlocksExactly& blocks_exactly;
};

/// Runs the faces over the points of a raster. Memory is kept from one light to the next.
class ShadowFaces {
 public:
  /// Marks each point that some face blocks.
  void run(const ShadowRun& run, ShadowPoints& points, Counters& counters);

  std::size_t memory_bytes() const noexcept;

 private:
  void sift(const ShadowRun& run, const ShadowPoints& points, std::size_t first, std::size_t last);
  void drop_odd_faces(const Scene& scene, std::size_t first);
  void queue_across(const ShadowRun& run, const simd::ShadowRaster& raster);
  void test_first(const ShadowRun& run, ShadowPoints& points, std::size_t count, Counters& counters);
  void settle_sides(const ShadowRun& run, std::size_t count, Counters& counters);
  void resolve(const ShadowRun& run, ShadowPoints& points);
  void decide_given(const ShadowRun& run, ShadowPoints& points);

  std::vector<float> places_;                   ///< of vertices, three a vertex
  simd::SiftedFaces queue_;                     ///< faces to be tested
  std::vector<std::uint32_t> corners_of_some_;  ///< three a face
  std::vector<simd::ShadowCorners> corners_;
  std::vector<simd::ShadowPlanes> planes_;
  std::vector<std::int8_t> sides_;
  simd::ShadowJobs jobs_;
  std::vector<simd::UndecidedPair> undecided_;
  std::vector<simd::GivenPair> given_;  ///< those of given points, with their verdicts
  std::vector<std::uint8_t> verdicts_;
};

}  // namespace facemap
