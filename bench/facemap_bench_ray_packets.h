#pragma once

#include <embree3/rtcore.h>
#include <facemap/vector.h>

namespace facemap::bench {

/// A ray from a light ends this fraction short of its point, so that the point's own face does not hide it.
constexpr float kShort = 0x1p-12f;

/// Embree's packets of one width: their types and functions.
struct Packet16 {
  static constexpr int kWidth = 16;
  using Ray = RTCRay16;
  using RayHit = RTCRayHit16;
  static constexpr auto intersect = rtcIntersect16;
  static constexpr auto occluded = rtcOccluded16;
};
struct Packet8 {
  static constexpr int kWidth = 8;
  using Ray = RTCRay8;
  using RayHit = RTCRayHit8;
  static constexpr auto intersect = rtcIntersect8;
  static constexpr auto occluded = rtcOccluded8;
};
struct Packet4 {
  static constexpr int kWidth = 4;
  using Ray = RTCRay4;
  using RayHit = RTCRayHit4;
  static constexpr auto intersect = rtcIntersect4;
  static constexpr auto occluded = rtcOccluded4;
};

/// What all rays from one origin share.
template <class Ray>
void set_common(Ray& rays, const Vector& origin, int width) {
  for (int i = 0; i < width; ++i) {
    rays.org_x[i] = origin.x;
    rays.org_y[i] = origin.y;
    rays.org_z[i] = origin.z;
    rays.tnear[i] = 0;
    rays.time[i] = 0;
    rays.mask[i] = 0xffffffffu;
    rays.id[i] = 0;
    rays.flags[i] = 0;
  }
}

}  // namespace facemap::bench
