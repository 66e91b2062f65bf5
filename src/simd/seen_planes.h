#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/seen_rays.h"

/// Planes of the faces that a camera sees, in double precision: where rays meet them, and on which side lights are.
/// Letters as in math/exact_sign.h; u = 2^-53. No expression here can overflow or underflow to less than it should:
/// products of three differences of floats stay between 2^-447 and 2^390.
namespace facemap::simd {

/// A computed n . (a - P), P a float32 point, is off by less than this share of the sum of spread_i |a_i - P_i|: 2 u
/// for the differences of n, 1 for its products, 1 for its subtraction; 1 for a - P, 3 for the dot product. Twice these
/// 8 u have room for what is of second order.
inline constexpr double kOffsetError = 0x1p-49;

/// Faces about a camera K.
struct PlaneBatch {
  std::size_t count = 0;
  float corners[9][kSeenBatch] = {};     ///< a.x, a.y, a.z, b.x, ...
  double normal[3][kSeenBatch] = {};     ///< n
  double spread[3][kSeenBatch] = {};     ///< sum of |products| of each component: n is off by at most 4 u of it
  double offset[kSeenBatch] = {};        ///< n . (a - K)
  double offset_error[kSeenBatch] = {};  ///< |offset - true| <= this; if 0, it is exact
  double slope_error[kSeenBatch] = {};   ///< where |n . d| >= slope_error / e, a ray's point is known to within e
};

/// Fills the corners of planes.count faces, of three indices a triangle and three coordinates a vertex.
void load_corners(const std::uint32_t* triangles, const float* positions, const std::uint32_t* faces,
                  PlaneBatch& planes);

/// Fills all but corners.
void set_up_planes(PlaneBatch& planes, const float K[3]);

/// For lights[0..light_count), at most 8, positions, or directions of parallel light where bit l of `parallel` is set:
/// bit l of facing[face] is set if K and light l are surely on the same side of the plane, strictly; bit l of
/// unsure[face] if doubles can't tell.
void find_facing(const PlaneBatch& planes, const float (*lights)[3], int light_count, unsigned parallel,
                 std::int32_t* facing, std::int32_t* unsure);

/// Rays of a batch, and the faces that they see.
struct RayBatch {
  std::size_t count = 0;
  double map_x[kSeenBatch] = {}, map_y[kSeenBatch] = {};  ///< for ray_directions
  std::int64_t slots[kSeenBatch] = {};                    ///< the face's place in a PlaneBatch
  float direction[3][kSeenBatch] = {};
  double offset[3][kSeenBatch] = {};  ///< of the point P from an origin O
};

/// Fills rays.offset with base + t d, where base = K - O. Returns whether some point may be off by more than `allowed`
/// besides the rounding of offsets; is_sharp[i] says which is not.
bool meet_planes(const PlaneBatch& planes, const double base[3], double allowed, RayBatch& rays,
                 std::uint8_t* is_sharp);

/// Offsets in multiples of a power of two, to nearest, ties to even. False if some is not below 2^30 in magnitude.
bool round_offsets(const RayBatch& rays, double inverse_step, std::int32_t* x, std::int32_t* y, std::int32_t* z);

}  // namespace facemap::simd
