#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/shadow_frame.h"

namespace facemap::simd {

/// Sixteen points of a light's raster, ready to be held against a face.
struct alignas(64) ShadowBlock {
  static constexpr std::size_t kPoints = 16;
  float u[kPoints];
  float v[kPoints];
  float w[kPoints];
  std::uint32_t own_face[kPoints];  ///< never blocks its point
};

/// One point before it is in its block: the same four numbers side by side.
struct ShadowRecord {
  float u, v, w;
  std::uint32_t own_face;
};

/// Of the points with wanted[i] != 0: how many they are, and the box of their integers. `wanted` is readable for 64
/// elements past its end.
struct WantedPoints {
  std::size_t count;
  std::int32_t lower[3], upper[3];
};
WantedPoints measure_wanted(const std::int32_t* x, const std::int32_t* y, const std::int32_t* z,
                            const std::uint8_t* wanted, std::size_t count);

/// Asked points i with (wanted[i] & bit) != 0. (X, Y, Z) = matrix (x, y, z) + offset. `wanted` is readable for 64
/// elements past its end.
struct PointsToProject {
  const std::int32_t* x;
  const std::int32_t* y;
  const std::int32_t* z;
  const std::uint32_t* own_faces;
  const std::uint8_t* wanted;
  std::uint8_t bit;
  std::size_t count;
  double matrix[3][3];
  double offset[3];
  float nearest;  ///< points with a lesser Z are not for the raster
};

/// First pass: adds one to counts[row * columns + column] of each point's texel, and appends to `rest` the points that
/// are too near or not on the raster. Returns how many are on it. `occupied`: one bit a spot of the raster that is
/// kSpotColumns x kSpotRows times finer, set where a point lies; null: not wanted.
///
/// Each of u, v, 1 and w is off by at most two roundings of float32 from what a common factor makes of the true ones,
/// the error of X, Y and Z themselves apart: r = 1 / Z is rounded, and Z r is taken for 1.
std::size_t count_points(const PointsToProject& from, const ShadowRaster& raster, std::uint32_t* counts,
                         std::uint8_t* occupied, std::vector<std::uint32_t>& rest);

/// Second pass: puts each point that the first counted at the next place of its texel, where next[texel] counts up. At
/// `records` there is room for a ShadowRecord a place.
void place_points(const PointsToProject& from, const ShadowRaster& raster, std::uint32_t* next, std::byte* records,
                  std::uint32_t* point_of_place);

/// Turns each block of 16 records into a ShadowBlock, in place, and finds its least w.
void finish_blocks(ShadowBlock* blocks, std::size_t count, float* farthest);

}  // namespace facemap::simd
