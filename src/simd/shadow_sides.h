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

/// For each point with the first bit of wanted[i] set: bit `side` takes its place, the side that has the greatest
/// component of (X, Y, Z), as float32 has them. `wanted` is that of `from`.
SideCounts split_by_side(const PointsToProject& from, std::uint8_t* wanted);

}  // namespace facemap::simd
