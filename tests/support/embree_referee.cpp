#include "support/embree_referee.h"

#include <embree3/rtcore.h>

#include <cstring>
#include <limits>

using facemap::Mesh;
using facemap::Vector;

struct EmbreeReferee::Device {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Device() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

EmbreeReferee::EmbreeReferee(const Mesh& mesh, bool robust) : device_(std::make_unique<Device>()) {
  Device& d = *device_;
  d.device = rtcNewDevice("threads=1");
  d.scene = rtcNewScene(d.device);
  if (robust) rtcSetSceneFlags(d.scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(d.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vector),
                                            mesh.positions.size());
  std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vector));
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(facemap::Corners), mesh.triangles.size());
  std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(facemap::Corners));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(d.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(d.scene);
}

EmbreeReferee::~EmbreeReferee() = default;

static RTCRay ray_of(const Vector& origin, const Vector& direction, float tfar) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = tfar;
  ray.mask = 0xffffffffu;
  return ray;
}

EmbreeReferee::Hit EmbreeReferee::nearest(const Vector& origin, const Vector& direction) const {
  RTCRayHit query{};
  query.ray = ray_of(origin, direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(device_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {static_cast<facemap::FaceId>(query.hit.primID), query.ray.tfar,
          Vector(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z)};
}

bool EmbreeReferee::is_blocked(const Vector& from, const Vector& to) const {
  RTCRay ray = ray_of(from, to - from, 1 - 0x1p-12f);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(device_->scene, &context, &ray);
  return ray.tfar < 0;
}
