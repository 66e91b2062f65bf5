#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "map/parallel_frame.h"

namespace facemap {

/// What a map knows of each face as seen along d, by face id: its s (math/parallel_signs.h, exact), and in float32 its
/// three edges, its plane and a bound of its depth, for a filter in front of the exact signs. Odd faces have s = 0.
class ParallelFaces {
 public:
  ParallelFaces(const Scene& scene, const Vector& direction, const ParallelFrame& frame);

  /// Of no face yet: for those who ask face_of().
  explicit ParallelFaces(const ParallelFrame& frame) : frame_(frame) {}

  int side(std::uint32_t face) const { return sides_[face]; }

  /// Lower bound of the face's depth (ParallelFrame::depth), rounded down.
  float nearest(std::uint32_t face) const { return faces_[face].nearest; }

  /// A place as the filter takes it: map units, z cut to a little before and behind all faces.
  struct Asked {
    float x, y, z;
  };
  Asked asked(const ParallelFrame::Place& place) const;

  /// What the filter is sure of, for a place in the raster of an error that ParallelFrame::find puts into a texel.
  /// beyond: 1 if the place is strictly behind the face's plane, -1 if strictly before it, 0 if that is open.
  struct Sides {
    bool surely_outside, surely_inside;  ///< of the three edges
    int beyond;
  };
  Sides sides(std::uint32_t face, const Asked& asked) const { return sides(faces_[face], asked); }

  /// What the filter knows of a face: x p.x + y p.y + z p.z + c for three edges, which have no z, and the plane: at
  /// least 0 within the edges, above 0 behind the plane, each off by less than its error. Scaled so that the largest of
  /// x, y and z is within [1, 2).
  struct alignas(64) Face {
    float x[4], y[4], c[4];
    float z, edge_error, plane_error, nearest;
  };
  Face face_of(const Vector (&corners)[3], int side) const;  ///< of a side that is not 0
  static Sides sides(const Face& face, const Asked& asked);

  std::size_t memory_bytes() const noexcept { return sides_.size() + faces_.size() * sizeof(Face); }

 private:
  const ParallelFrame& frame_;
  std::vector<std::int8_t> sides_;
  std::vector<Face> faces_;
};

}  // namespace facemap
