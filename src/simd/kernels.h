#pragma once

#include <cstddef>
#include <cstdint>

/// The hot loops, behind plain signatures: arrays of floats in, ids and verdicts out. What stands in
/// kernels_scalar.cpp is the definition; every other target must equal it bit for bit.
namespace facemap::simd {

/// A face's cone and plane about a map's origin O in float32, ready for a dot product each. Lengths are in map
/// units: world units times the map's power of two (FacePlanesTable::scale). Signs are folded in: a direction d
/// lies in the cone where all edge[i] . d >= 0, a point O + D beyond the plane where normal . D > offset.
struct FacePlanes {
  float edge[3][3];    ///< s (v[i] - O) x (v[i+1] - v[i])
  float normal[3];     ///< s (b - a) x (c - a)
  float offset;        ///< s normal . (a - O) > 0
  float edge_error;    ///< |computed edge . d - true| <= edge_error |d| + kUnderflow
  float normal_error;  ///< the same for normal . D
  float offset_error;  ///< and this much more for its difference with offset
};

/// What float32 underflow can lose in a dot product of planes and directions, flush-to-zero included.
inline constexpr float kUnderflow = 0x1p-110f;

/// Directions of a greater length (map units) are not for the filter: dot products could overflow.
inline constexpr float kLargestLength = 0x1p60f;

/// Verdict of the float32 filter on one face.
enum Verdict : std::uint8_t { kNo = 0, kYes = 1, kUndecided = 2 };

/// For each of `count` faces ids[i]: does direction d lie in its cone, edges included. `length` >= |d|.
/// A direction within 1.25 * 2^-24 |d| of d gets the same verdict unless it is kUndecided.
void cone_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const float d[3],
                   float length, Verdict* verdicts);

/// Walks the faces ids[0..count) until one surely blocks the point O + D or a face's `nearest` exceeds
/// `reach`. Face `skip` is passed over. Returns how many were looked at; undecided ones are appended to
/// `undecided` (room for `count`) unless a blocker was found. `length` >= |D|.
struct BlockWalk {
  std::size_t tested = 0;
  std::size_t undecided = 0;
  bool blocked = false;
};
BlockWalk find_blocker(const FacePlanes* planes, const float* nearest, const std::uint32_t* ids, std::size_t count,
                       const float D[3], float length, float reach, std::uint32_t skip, std::uint32_t* undecided);

}  // namespace facemap::simd
