#include "visibility_rays.h"

#include <algorithm>

#include "facemap_bench_ray_packets.h"

namespace facemap::bench {
namespace {

constexpr std::size_t kStream = 256;  // rays

// From, way and both ends of one ray.
struct Segment {
  Vector from, way;
  float near, far;
};

Segment segment(const Vector& origin, const Vector& point, const OcclusionWay& way) {
  if (way.hub_is_point) {
    return way.from_point ? Segment{point, origin - point, 0, 1 - kShort} : Segment{origin, point - origin, kShort, 1};
  }
  return way.from_point ? Segment{point, origin - point, kShort, 1} : Segment{origin, point - origin, 0, 1 - kShort};
}

RTCIntersectContext context_for(const OcclusionWay& way) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = way.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

template <class Packet>
void ask_packets(RTCScene scene, const Vector& origin, std::span<const Vector> points, const OcclusionWay& way,
                 std::uint8_t* visible) {
  constexpr int kWidth = Packet::kWidth;
  RTCIntersectContext context = context_for(way);
  alignas(64) typename Packet::Ray rays;
  alignas(64) int valid[kWidth];
  set_common(rays, origin, kWidth);
  for (std::size_t first = 0; first < points.size(); first += kWidth) {
    const std::size_t count = std::min(points.size() - first, std::size_t{kWidth});
    for (std::size_t i = 0; i < kWidth; ++i) {
      const Segment s = segment(origin, points[first + std::min(i, count - 1)], way);
      rays.org_x[i] = s.from.x;
      rays.org_y[i] = s.from.y;
      rays.org_z[i] = s.from.z;
      rays.dir_x[i] = s.way.x;
      rays.dir_y[i] = s.way.y;
      rays.dir_z[i] = s.way.z;
      rays.tnear[i] = s.near;
      rays.tfar[i] = s.far;
      valid[i] = i < count ? -1 : 0;
    }
    Packet::occluded(valid, scene, &context, &rays);
    for (std::size_t i = 0; i < count; ++i) visible[first + i] = rays.tfar[i] >= 0;
  }
}

RTCRay ray_of(const Segment& s) {
  return {s.from.x, s.from.y, s.from.z, s.near, s.way.x, s.way.y, s.way.z, 0, s.far, 0xffffffffu, 0, 0};
}

void ask_streams(RTCScene scene, const Vector& origin, std::span<const Vector> points, const OcclusionWay& way,
                 std::uint8_t* visible) {
  RTCIntersectContext context = context_for(way);
  alignas(64) RTCRay rays[kStream];
  for (std::size_t first = 0; first < points.size(); first += kStream) {
    const std::size_t count = std::min(points.size() - first, kStream);
    for (std::size_t i = 0; i < count; ++i) rays[i] = ray_of(segment(origin, points[first + i], way));
    rtcOccluded1M(scene, &context, rays, static_cast<unsigned>(count), sizeof(RTCRay));
    for (std::size_t i = 0; i < count; ++i) visible[first + i] = rays[i].tfar >= 0;
  }
}

void ask_singly(RTCScene scene, const Vector& origin, std::span<const Vector> points, const OcclusionWay& way,
                std::uint8_t* visible) {
  RTCIntersectContext context = context_for(way);
  for (std::size_t i = 0; i < points.size(); ++i) {
    RTCRay ray = ray_of(segment(origin, points[i], way));
    rtcOccluded1(scene, &context, &ray);
    visible[i] = ray.tfar >= 0;
  }
}

}  // namespace

std::string OcclusionWay::name() const {
  static constexpr const char* kRays[] = {"packets", "streams of 256", "single rays"};
  return std::string(coherent ? "coherent " : "incoherent ") + kRays[static_cast<int>(rays)] +
         (from_point ? " from points" : " from the origin");
}

std::vector<OcclusionWay> occlusion_ways() {
  std::vector<OcclusionWay> ways;
  for (const auto rays : {OcclusionWay::Rays::Packets, OcclusionWay::Rays::Stream, OcclusionWay::Rays::Single}) {
    for (const bool coherent : {false, true}) {
      if (rays == OcclusionWay::Rays::Single && coherent) continue;  // the same
      for (const bool from_point : {false, true}) ways.push_back({rays, coherent, from_point});
    }
  }
  return ways;
}

void ask_embree(const Embree& embree, const Vector& origin, std::span<const Vector> points, const OcclusionWay& way,
                std::uint8_t* visible) {
  const RTCScene scene = embree.hierarchy();
  if (way.rays == OcclusionWay::Rays::Stream) return ask_streams(scene, origin, points, way, visible);
  if (way.rays == OcclusionWay::Rays::Single) return ask_singly(scene, origin, points, way, visible);
  if (embree.packet_width() == 16) return ask_packets<Packet16>(scene, origin, points, way, visible);
  if (embree.packet_width() == 8) return ask_packets<Packet8>(scene, origin, points, way, visible);
  ask_packets<Packet4>(scene, origin, points, way, visible);
}

}  // namespace facemap::bench
