#pragma once

#include <cstddef>
#include <cstdint>

namespace facemap::simd {

/// Points that float32 numbers are exactly, and faces, about a light.
struct GivenPoints {
  const float* points;           ///< three a point
  const std::uint32_t* corners;  ///< three a face
  const float* positions;        ///< three a vertex
  float light[3];
};

/// A point and a face that may stand between it and the light.
struct GivenPair {
  std::uint32_t point, face;
};

/// What plain::blocks (math/plain_signs.h) says of each pair: 0 no, 1 yes, 2 open; and no for points in faces' planes
/// along the axes, which it leaves open. The same on every target.
void decide_pairs(const GivenPoints& given, const GivenPair* pairs, std::size_t count, std::uint8_t* verdicts);

}  // namespace facemap::simd
