#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/nearest_target.h"

namespace facemap::simd {

/// A linear frame about the camera K in which rays are (u, v, 1), and what doubles lose in it. With (X, Y, Z) =
/// rows * (p - K): u = X/Z and v = Y/Z, in samples from the picture's centre; Z in units that bring the scene near 1.
struct PlaneFrame {
  double origin[3];
  double rows[3][3];  ///< each a double taken as exact; their determinant is positive
  double unit;        ///< length of the third row
  double shift;       ///< samples: |u| and |v| by which a ray may pass from its sample's centre

  /// With r the offset of a face's first corner and q its two edges there, lengths (sums of components) in `unit`s, and
  /// f the length of the first two rows over the third's, U and V the greatest |u| and |v| of any sample: see
  /// nearest_planes.cpp.
  double value_error;        ///< of an edge's value: times q (2 r + q); of a w, times |D|: times q^2
  double determinant_error;  ///< of D: times q^2 r
};

/// Three edge planes and the plane of inverse depth over a box of samples, (dx, dy) counted from its first sample,
/// for 16 faces. An edge's value A dx + B dy + C is 1 or more if the sample's ray is surely inside, below -1 if surely
/// outside.
struct alignas(64) FaceBlock {
  float A[3][kBlockFaces], B[3][kBlockFaces], C[3][kBlockFaces];
  float Aw[kBlockFaces], Bw[kBlockFaces], Cw[kBlockFaces];
  float sharp[kBlockFaces];  ///< a w not below it is sharp; above 0
  /// Faces nearly edge-on, whose side doubles cannot tell; as drawn they cover nothing.
  std::uint8_t is_unsure[kBlockFaces];
  bool has_unsure;
};

/// The same in double for one large face, (u, v) counted from the picture's centre. The bounds hold for kLargeRun
/// columns of kBlockSide rows at a time, whose first value is rounded to float32.
inline constexpr int kLargeRun = 64;
struct LargeFace {
  double A[4], B[4], C[4];  ///< three edges, then w
  float sharp;
  std::uint8_t is_unsure;
};

/// `sharp` where no w is.
inline constexpr float kNeverSharp = 3e38f;

/// What faces are made from: three indices a triangle, three coordinates a vertex.
struct FaceSource {
  const std::uint32_t* triangles;
  const float* positions;
};

/// Up to 16 faces and their boxes. The arrays can be read for kBlockFaces elements, whatever stands there.
struct FaceBoxes {
  const std::uint32_t* faces;
  const std::int32_t *x0, *x1, *y0, *y1;
  std::size_t count;  ///< 1..16
};

/// `first_u`, `first_v`: the centre of sample (0, 0).
void set_up_faces(const FaceSource& source, const PlaneFrame& frame, double first_u, double first_v,
                  const FaceBoxes& boxes, FaceBlock& block);

/// The same block for samples anywhere in a tile, (u, v) counted from the frame's axis: `reach` is their greatest |u|
/// or |v|.
void set_up_tile_faces(const FaceSource& source, const PlaneFrame& frame, double reach, const std::uint32_t* faces,
                       std::size_t count, const std::int8_t* sides, FaceBlock& block);

/// `sides`: exact sides of faces known to be unsure (then never sharp), or null.
void set_up_large(const FaceSource& source, const PlaneFrame& frame, const std::uint32_t* faces, std::size_t count,
                  const std::int8_t* sides, LargeFace* large);

}  // namespace facemap::simd
