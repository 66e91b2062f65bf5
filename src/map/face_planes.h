#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "math/exact_sign.h"
#include "simd/face_kernels.h"

namespace facemap {

namespace simd {
struct SetupPlanes;
}

/// What a map knows of each face about its origin O, by face id: on which side of its plane O lies (exact), the
/// float32 planes of the filter, and bounds of its distance. Odd faces have side 0.
class FacePlanesTable {
 public:
  FacePlanesTable(const Scene& scene, const Vector& origin);

  /// Map units a world unit: a power of two that brings the far side of the scene's bounding sphere to within [1, 2),
  /// so that no product of the filter overflows whatever the scene's size.
  double scale() const noexcept { return scale_; }

  int side(std::uint32_t face) const { return sides_[face]; }
  const simd::FacePlanes* planes() const noexcept { return planes_.data(); }

  /// Lower bound of the distance of face `id` from O (map units, rounded down).
  float nearest(std::uint32_t face) const { return planes_[face].nearest; }

  /// Ids of the faces that O does not see edge-on, by nearest bound, then id.
  std::vector<std::uint32_t> front_to_back(const Scene& scene) const;

  std::size_t memory_bytes() const noexcept;

 private:
  void store(const simd::SetupPlanes& from, std::size_t i, int side, simd::FacePlanes& to) const;

  double scale_ = 1;
  std::vector<std::int8_t> sides_;
  std::vector<simd::FacePlanes> planes_;
};

/// The corners of a face.
Triangle triangle_of(const Scene& scene, std::uint32_t face);

/// Rounded towards minus or plus infinity (the argument may be off by a relative 2^-40).
float float_below(double x);
float float_above(double x);

/// Lower bound of |p| over a triangle whose corners are at least `nearest_corner` from O and whose longest edge
/// has length `longest_edge`: |p|^2 = sum l_i |v_i|^2 - sum l_i l_j |v_i - v_j|^2 >= min |v|^2 - longest^2 / 3.
double distance_bound(double nearest_corner, double longest_edge);

}  // namespace facemap
