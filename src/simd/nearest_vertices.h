#pragma once

#include <cstddef>
#include <cstdint>

namespace facemap::simd {

/// Where a vertex cannot be given a point of the picture, u is a NaN whose low bits say on which sides of the view the
/// vertex surely lies (0: not known of any).
enum Outside : std::uint32_t { kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8, kBehind = 16 };
inline constexpr std::uint32_t kOutsideBits = 31;
inline constexpr std::uint32_t kNoPoint = 0x7fc00000u;  ///< the NaN's other bits

/// A plane projection in float32: u = X/Z, v = Y/Z, in samples from the picture's centre, v downwards, where
/// (X, Y, Z) = rows * (vertex - origin).
struct VertexFrame {
  float origin[3];
  float rows[3][3];
  float unit;                       ///< length of the third row
  float limit;                      ///< points with |u| or |v| beyond it are not given
  float edge_u, edge_v;             ///< |u| and |v| beyond these are outside the view
  float slack_u, slack_v, slack_z;  ///< errors of X +- edge_u Z, Y +- edge_v Z and Z, times unit |vertex - origin|
};

/// Z below this (scene's units of about 1) is too near for a point.
inline constexpr float kLeastDepth = 0x1p-60f;

/// Vertices nearer or farther than these (the same unit) have no point of a surface projection.
inline constexpr float kLeastLength = 0x1p-30f, kLargestLength = 0x1p30f;

/// The surface projection: the distance of (u, v) from the centre is the angle from the third row, `per_radian` samples
/// each. The first two rows are per_radian times the third's length; outside bits are those of the pyramid through
/// edge_u and edge_v.
struct SurfaceFrame {
  VertexFrame frame;  ///< its limit is not used
  float per_radian;
  float largest_angle;  ///< radians; points beyond it are not given
};

/// Error of the computed angle, radians: atan's polynomial (Abramowitz and Stegun 4.4.49, 2^-25) and its roundings.
inline constexpr float kAngleError = 0x1p-19f;

/// Room for a vector of vertices.
inline constexpr std::size_t kVertexRoom = 16;

/// Points (u, v) of `count` vertices from their positions (x, y, z). Writes `count` points and no more: what follows
/// them may be the work of another thread.
void project_vertices(const float* positions, std::size_t count, const VertexFrame& frame, float* points);
void project_vertices_surface(const float* positions, std::size_t count, const SurfaceFrame& frame, float* points);

}  // namespace facemap::simd
