#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/shadow_points.h"

namespace facemap::simd {

/// The sides of a cube about a light: side 2 axis + (1 if against the axis).
inline constexpr int kSides = 6;

/// How many points each side has.
struct SideCounts {
  std::size_t of[kSides] = {};
};

/// Sets bit `side` of bits[k] alone, the side that has the greatest component of (X, Y, Z) of the list's point k, as
/// float32 has them. `bits` has room like the list.
SideCounts split_by_side(const ListedPoints& list, const PointTransform& transform, std::uint8_t* bits);

}  // namespace facemap::simd
