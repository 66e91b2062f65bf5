#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/listed_points.h"
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

/// (X, Y, Z) = matrix (x, y, z) + offset.
struct PointTransform {
  double matrix[3][3];
  double offset[3];
  float nearest;  ///< points with a lesser Z are not for the raster
};

/// Asked points i with (wanted[i] & bit) != 0.
struct PointsToProject : PointTransform {
  const std::int32_t* x;
  const std::int32_t* y;
  const std::int32_t* z;
  const std::uint8_t* wanted;
  std::uint8_t bit;
  std::size_t count;
};

/// Points of a list on a raster, in its memory; those that have no place there are gone.
struct ProjectedPoints {
  std::int32_t *u, *v, *w;  ///< the bits of floats
  std::uint32_t* numbers;
  std::uint32_t* texels;  ///< row * columns + column
  std::uint32_t* ranks;   ///< in the texel
  std::size_t count;
};

/// What a raster's texels and spots are found to hold.
struct TexelCounts {
  std::uint32_t* of;  ///< one is added to a texel for each of its points
  std::uint8_t*
      occupied;  ///< one bit a spot of a raster that is kSpotColumns x kSpotRows times finer; null: not wanted
};

/// Projects a list; `texels` and `ranks` have room like it. Appends to `rest` the numbers of points that are too near
/// or not on the raster.
///
/// Each of u, v, 1 and w is off by at most two roundings of float32 from what a common factor makes of the true ones,
/// the error of X, Y and Z themselves apart: r = 1 / Z is rounded, and Z r is taken for 1.
ProjectedPoints project_points(const ListedPoints& list, const PointTransform& transform, const ShadowRaster& raster,
                               std::uint32_t* texels, std::uint32_t* ranks, const TexelCounts& counts,
                               std::vector<std::uint32_t>& rest);

/// What points become, by place. At `records` there is room for a ShadowRecord a place.
struct PlacedPoints {
  std::byte* records;
  std::uint32_t* point_of_place;
};

/// Puts each point at place begins[texel] + rank. `own_faces`: of all points, by number.
void place_points(const ProjectedPoints& points, const std::uint32_t* own_faces, const std::uint32_t* begins,
                  const PlacedPoints& to);

/// Turns each block of 16 records into a ShadowBlock, in place, and finds its least w.
void finish_blocks(ShadowBlock* blocks, std::size_t count, float* farthest);

}  // namespace facemap::simd
