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

/// Where they go, in order; room for 16 more than are wanted in each.
struct ProjectedPoints {
  ShadowRecord* records;
  std::uint32_t* texels;             ///< row * columns + column
  std::uint32_t* points;             ///< which of the asked points
  std::uint32_t* spots;              ///< as texels, of the finer raster; null: not wanted
  std::vector<std::uint32_t>* rest;  ///< appended to: the points that are too near or not on the raster
  std::size_t count = 0;
};

/// Each of u, v, 1 and w is off by at most two roundings of float32 from what a common factor makes of the true ones,
/// the error of X, Y and Z themselves apart: r = 1 / Z is rounded, and Z r is taken for 1.
void project_points(const PointsToProject& from, const ShadowRaster& raster, ProjectedPoints& to);

/// Turns each block of 16 records into a ShadowBlock, in place, and finds its least w.
void finish_blocks(ShadowBlock* blocks, std::size_t count, float* farthest);

}  // namespace facemap::simd
