#pragma once

#include <facemap/mesh.h>
#include <facemap/vector.h>

#include <memory>

/// A second opinion from a general ray tracer (Embree 3): fast and rounded, so where it differs the oracle decides.
class EmbreeReferee {
 public:
  /// `robust`: its watertight mode.
  EmbreeReferee(const facemap::Mesh& mesh, bool robust);
  ~EmbreeReferee();

  struct Hit {
    facemap::FaceId face = facemap::kNoFace;
    float t = 0;             ///< in lengths of the direction
    facemap::Vector normal;  ///< of the face, not normalized
  };
  Hit nearest(const facemap::Vector& origin, const facemap::Vector& direction) const;

  /// Whether something lies on the segment, short of its end by a relative 2^-12.
  bool is_blocked(const facemap::Vector& from, const facemap::Vector& to) const;

 private:
  struct Device;
  std::unique_ptr<Device> device_;
};
