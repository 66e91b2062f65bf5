#pragma once

#include <cstdint>

namespace facemap::simd {

/// How a light sees a part of space: as on a plane in front of it. For a point p, (X, Y, Z) = rows (p - light), and
/// u = X / Z, v = Y / Z, w = 1 / Z. The raster is the square |u| <= 1, |v| <= 1; Z is above 0 in front of the light.
///
/// The nine doubles are exact by definition. Any rows of positive determinant keep the sign of every determinant
/// about the light, so they need be neither orthogonal nor of unit length, and nothing is lost where they were rounded.
/// Straight lines stay straight, so a face is a triangle on the plane, and w is linear over it.
struct ShadowFrame {
  double rows[3][3];
  double light[3];  ///< float32 values
  double largest;   ///< of the |rows[i][j]|
};

/// Columns and rows of texels that the raster is cut into; powers of two.
struct ShadowRaster {
  int columns = 1;
  int rows = 1;
};

/// Each texel is cut into this many columns and rows of spots where faces far outnumber points: whether a spot has a
/// point is one bit.
inline constexpr int kSpotColumns = 4;
inline constexpr int kSpotRows = 8;

/// Half a unit in the last place, relative: what one float32 operation may be off.
inline constexpr double kShadowHalfUlp = 0x1p-24;

/// How far X, Y or Z of a point may be off, relative to Z, in units of 2^-24: points nearer to the light are not
/// placed.
inline constexpr double kShadowGreatestSlack = 4;

/// How far (u and v alike, the raster being 2 wide) a point of a face may be outside the box of the face's projected
/// vertices. A vertex: four roundings (X, Z, the division, the product), 2^-22 of at most 1 where it matters, and
/// 2^-22 (1 + |u|) for the doubles (kShadowSteepest): 12 * 2^-24. A point: four roundings, and kShadowGreatestSlack for
/// X and for Z: 12 * 2^-24. Together below 2^-19; the way to a texel's number is off by 2^-23 at most. A box side
/// beyond the raster's own side is off by more, but only relative to itself.
inline constexpr float kShadowMargin = 0x1p-18f;

/// A vertex has a place on the plane only if Z is at least this share of `largest` |p - light|_1: then Z and the
/// place are off by less than 2^-22, relative to Z and to 1 + |u|.
inline constexpr double kShadowSteepest = 0x1p-29;

/// And if |Z| is within these, so that neither it nor 1 / Z leaves float32.
inline constexpr double kShadowLeastZ = 0x1p-100;
inline constexpr double kShadowGreatestZ = 0x1p100;

/// What may hide between a computed w and a true one, relative: 2^-22 for a vertex and about as much for a point.
inline constexpr float kShadowDepthFactor = 1 + 0x1p-16f;

}  // namespace facemap::simd
