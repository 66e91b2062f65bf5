#pragma once

#include <facemap/vector.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "facemap_bench_embree.h"

namespace facemap::bench {

/// How Embree is asked which points see an origin.
struct OcclusionWay {
  enum class Rays { Packets, Stream, Single } rays = Rays::Packets;
  bool coherent = false;
  bool from_point = false;    ///< else from the origin to the point, short of it
  bool hub_is_point = false;  ///< what is called the origin is the point, and the points are origins

  std::string name() const;
};

/// All of them.
std::vector<OcclusionWay> occlusion_ways();

/// Sets visible[i] to 1 if no face of the hierarchy stands between the origin and points[i], else to 0. `width` of
/// packets. One thread's work.
void ask_embree(const Embree& embree, const Vector& origin, std::span<const Vector> points, const OcclusionWay& way,
                std::uint8_t* visible);

}  // namespace facemap::bench
