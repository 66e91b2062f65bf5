#pragma once

#include <cstddef>
#include <cstdint>

/// The float32 filter on lists of faces, behind plain signatures: arrays of floats in, ids and verdicts out. Every
/// target gives the same bits (tests/unit/face_kernels_test.cpp has the definition as a loop over faces).
namespace facemap::simd {

/// A face's cone and plane about a map's origin O in float32, ready for four dot products at once. Lengths are in map
/// units: world units times the map's power of two (FacePlanesTable::scale). Signs are folded in: a direction d
/// lies in the cone where all edge[i] . d >= 0, a point O + D beyond the plane where normal . D > offset.
struct alignas(64) FacePlanes {
  float x[4];  ///< first components of edge[0], edge[1], edge[2] and normal: s (v[i] - O) x (v[i+1] - v[i])
  float y[4];  ///< and s (b - a) x (c - a), each times a power of two that brings its length to within [1, 2)
  float z[4];
  float offset;        ///< s normal . (a - O) > 0
  float error;         ///< |computed plane . d - true| <= error |d| + kUnderflow
  float offset_error;  ///< and this much more for the difference of normal . D and offset
  float nearest;       ///< lower bound of the face's distance from O (map units, rounded down)
};

/// What float32 underflow can lose in a dot product of planes and directions, flush-to-zero included.
inline constexpr float kUnderflow = 0x1p-110f;

/// Directions of a greater length (map units) are not for the filter: dot products could overflow.
inline constexpr float kLargestOffset = 0x1p60f;

/// Verdict of the float32 filter on one face.
enum Verdict : std::uint8_t { kNo = 0, kYes = 1, kUndecided = 2 };

/// For each of `count` faces ids[i]: does direction d lie in its cone, edges included. `length` >= |d|.
/// A direction within 1.25 * 2^-24 |d| of d gets the same verdict unless it is kUndecided.
void cone_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const float d[3],
                   float length, Verdict* verdicts);

/// A point O + D as the filter takes it, map units.
struct ListPoint {
  float D[3];
  float length;  ///< >= |D|
  float reach;   ///< faces that begin beyond it cannot block
};

/// For each of `count` faces ids[i]: does it stand strictly between O and the point, edges included.
void block_verdicts(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const ListPoint& point,
                    Verdict* verdicts);

/// Walks the faces ids[0..count), front to back, until one surely blocks the point or one begins beyond its reach.
/// Face `skip` is passed over. Returns how many were looked at; undecided ones are appended to `undecided` (room for
/// `count`) unless a blocker was found.
struct BlockWalk {
  std::size_t tested = 0;
  std::size_t undecided = 0;
  bool blocked = false;
  bool ended = false;  ///< at a face beyond the reach
};
BlockWalk find_blocker(const FacePlanes* planes, const std::uint32_t* ids, std::size_t count, const ListPoint& point,
                       std::uint32_t skip, std::uint32_t* undecided);

/// Points that are asked together.
inline constexpr std::size_t kChunk = 64;

/// For each of `count` (at most kChunk) points its list ids[i][0..counts[i]): what find_blocker would answer, kNo or
/// kYes, or kUndecided where a face is. Returns how many faces decided something for the points with an answer.
std::size_t find_blockers(const FacePlanes* planes, const std::uint32_t* const* ids, const std::uint32_t* counts,
                          const ListPoint* points, std::size_t count, Verdict* verdicts);

}  // namespace facemap::simd
