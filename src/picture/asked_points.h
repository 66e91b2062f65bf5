#pragma once

#include <facemap/vector.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "picture/bytes_of.h"
#include "picture/unset_vector.h"
#include "simd/listed_points.h"

namespace facemap {

/// "This point lies on no face."
inline constexpr std::uint32_t kNoOwnFace = 0xffffffffu;

/// Points that lights are asked about, in an order that keeps neighbours together. Coordinates are held as 32-bit
/// integers: point i is within `error` of origin + step * (x[i], y[i], z[i]).
struct AskedPoints {
  DVector origin{0};
  double step = 1;   ///< world units, above 0
  double error = 0;  ///< world units, rounding to integers included
  UnsetVector<std::int32_t> x, y, z;
  UnsetVector<std::uint32_t> faces;    ///< the face a point lies on, which never blocks it, or kNoOwnFace
  UnsetVector<std::uint32_t> samples;  ///< the sample of the picture that sees it
  const float* given = nullptr;        ///< where the points are exactly, three floats each; null: float32 can't say

  std::size_t size() const noexcept { return x.size(); }
};

/// Of coordinates, faces and samples.
inline std::size_t bytes_of(const AskedPoints& points) {
  return bytes_of(points.x) + bytes_of(points.y) + bytes_of(points.z) + bytes_of(points.faces) +
         bytes_of(points.samples);
}

/// For kernels.
inline simd::PointArrays arrays_of(const AskedPoints& points) {
  return {points.x.data(), points.y.data(), points.z.data(), points.size()};
}

/// Where a point is, world units.
DVector place_of(const AskedPoints& points, std::uint32_t point);

/// Of each coordinate of place_of, the roundings there included; of an offset from the light too, as long as those are
/// bounded by its own size (verdict_on of near_face.h).
double error_of(const AskedPoints& points, std::uint32_t point);

/// Makes `some` the points of these numbers, all but their samples: those of places `first` on, as the ones before are
/// there already.
void copy_points(const AskedPoints& points, const std::vector<std::uint32_t>& numbers, std::size_t first,
                 AskedPoints& some);

}  // namespace facemap
