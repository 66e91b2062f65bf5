#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/given_pairs.h"

namespace facemap::simd {

/// Where the entries of each texel begin: those of sixteen texels side by side within 2^16 of each other. There is one
/// texel more than the raster has, where all entries end.
struct ListBegins {
  static constexpr std::size_t kTexels = 16;

  const std::uint32_t* of_sixteen;
  const std::uint16_t* from_there;

  std::size_t operator[](std::size_t texel) const {
    return std::size_t{of_sixteen[texel / kTexels]} + from_there[texel];
  }
};

/// For each texel of a light's raster the faces that may stand between the light and a point that is left open. All
/// corners are well in front of the light. Entries and spots are readable for 16 more than there are.
struct FaceLists {
  ListBegins begins;
  const std::uint32_t* entries;  ///< depth << face_bits | face: a point of a greater depth is nearer than the face
  const std::uint16_t* spots;    ///< of each entry, one bit for each spot of the texel that the face may meet
  int face_bits;
  int depth_shift;               ///< so many of a point's 16 bits of depth are left out
  const std::uint32_t* corners;  ///< three a face
  const float* positions;        ///< three a vertex
  float light[3];
};

/// Points to be asked. A point's offset from the light is offset + step (x, y, z); along each axis it is off by at most
/// 2^-23 of the sum of its components' sizes.
struct PointsToList {
  const std::int32_t* x;
  const std::int32_t* y;
  const std::int32_t* z;
  const std::uint32_t* own_faces;  ///< never blocks its point
  double step;
  double offset[3];
  const std::uint32_t* numbers;  ///< of the points, in x, y, z and own_faces
  const std::uint32_t* texels;
  const std::uint32_t* depths;  ///< spot << 16 | depth
  std::size_t count;
};

/// A point and a face of its list of which float32 can't say whether it stands before the point.
using OpenPair = GivenPair;

/// Offsets from the light, of faces and points, have their greatest component within these: nothing overflows, and
/// what underflow loses is less than the filter's bounds allow for.
inline constexpr double kLeastListedSize = 0x1p-16, kGreatestListedSize = 0x1p20;

/// Faces and vertices are gathered by 32-bit numbers, three a face or vertex.
inline constexpr std::size_t kMostListed = std::size_t{1} << 29;

/// Sets dark[number] to 1 for each point that a face of its list surely blocks, and appends the pairs that are left
/// open, some of them of dark points. Returns how many pairs were decided. The same on every target, in the same order.
std::uint64_t ask_lists(const FaceLists& lists, const PointsToList& points, std::uint8_t* dark,
                        std::vector<OpenPair>& open);

}  // namespace facemap::simd
