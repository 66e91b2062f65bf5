#pragma once

#include <facemap/vector.h>

#include "simd/nearest_planes.h"

namespace facemap {

/// The directions of a tile's samples on a plane of its own, in blocks as in its raster; NaN where there is none.
struct TilePlane {
  static constexpr int kLargestTile = 32;  ///< samples a side

  simd::PlaneFrame frame;
  double reach = 0;  ///< greatest |u| or |v|
  alignas(64) float u[kLargestTile * kLargestTile] = {};
  alignas(64) float v[kLargestTile * kLargestTile] = {};

  /// The plane about the unit direction `z` (world), `f` samples a radian at its middle; `unit` as PlaneFrame::unit.
  void look_along(const DVector& z, double f, double unit, const Vector& position);

  /// Points of up to kSeenBatch directions of float32, for samples from number `first` on.
  void set_points(const float* x, const float* y, const float* z, std::size_t first, std::size_t count);

  double samples_a_radian() const { return per_radian_; }

  /// Once all points are there.
  void set_errors();

 private:
  double axes_[3][3];
  double per_radian_ = 1;
};

/// Rows x f, y f and z of a frame, each times `unit`.
void set_axes(const DVector& x, const DVector& y, const DVector& z, double f, double unit, simd::PlaneFrame& frame);

/// For samples with |u|, |v| <= reach.
void set_errors(double f, double reach, double shift, simd::PlaneFrame& frame);

}  // namespace facemap
