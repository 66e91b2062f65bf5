#pragma once

#include <facemap/vector.h>

#include <array>
#include <cstdint>

namespace facemap {

/// A triangle with a normal at each corner. Wang 2022, sec. 4.3: the Face class.
/// Normals need not be of unit length; a zero normal means "none", and the plane's own is used.
struct Face {
  std::array<Vector, 3> vertices;
  std::array<Vector, 3> normals{Vector(0), Vector(0), Vector(0)};
};

/// The number of a face: its triangle's index in the file's order after triangulation, from 0.
using FaceId = std::int32_t;

/// No face: nothing hit, nothing named.
inline constexpr FaceId kNoFace = -1;

}  // namespace facemap
