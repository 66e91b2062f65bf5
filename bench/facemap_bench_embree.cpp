#include "facemap_bench_embree.h"

#include <embree3/rtcore.h>
#include <facemap/error.h>
#include <facemap/instruction_set.h>
#include <pmmintrin.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "facemap_bench_clock.h"
#include "facemap_bench_packets.h"

namespace facemap::bench {
namespace {

/// Flush-to-zero and denormals-are-zero, as Embree asks.
class FlushToZero {
 public:
  FlushToZero() : before_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushToZero() { _mm_setcsr(before_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  unsigned before_;
};

}  // namespace

std::string EmbreeWay::name() const {
  static constexpr const char* kShadows[] = {"coherent packets", "incoherent packets", "packed coherent packets",
                                             "packed incoherent packets", "streams of 256"};
  return std::string(low_quality ? "low" : "medium") + (robust ? " robust" : "") + " build, " +
         (camera == Camera::Coherent ? "coherent" : "incoherent") + " packets, shadows " +
         kShadows[static_cast<int>(shadow)];
}

struct Embree::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::int64_t> bytes{0};
  std::unique_ptr<tbb::task_arena> arena;
};

Embree::Embree(const Scene& scene, int threads, bool cpu_time)
    : handles_(std::make_unique<Handles>()), scene_(&scene), threads_(threads), cpu_time_(cpu_time) {
  const std::string set = instruction_set();
  width_ = set == "avx512" ? 16 : set == "avx2" ? 8 : 4;
  const std::string isa = set == "avx512" ? ""
                          : set == "avx2" ? ",isa=avx2"
                          : set == "sse4" ? ",isa=sse4.2"
                                          : ",isa=sse2";
  handles_->device = rtcNewDevice(("threads=" + std::to_string(threads) + isa).c_str());
  if (!handles_->device) throw Error("Embree gives no device");
  if (width_ == 16 && !rtcGetDeviceProperty(handles_->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) width_ = 8;
  rtcSetDeviceMemoryMonitorFunction(
      handles_->device,
      [](void* handles, ssize_t bytes, bool) {
        static_cast<Handles*>(handles)->bytes += bytes;
        return true;
      },
      handles_.get());
  handles_->arena = std::make_unique<tbb::task_arena>(threads);
  if (scene.kept_faces().size() != scene.face_count()) {
    for (const std::uint32_t face : scene.kept_faces()) kept_.push_back(scene.mesh().triangles[face]);
  }
}

Embree::~Embree() {
  drop();
  rtcReleaseDevice(handles_->device);
}

void Embree::drop() {
  if (handles_->scene) rtcReleaseScene(handles_->scene);
  handles_->scene = nullptr;
}

std::int64_t Embree::bytes() const { return handles_->bytes; }

double Embree::build(bool low_quality, bool robust) {
  drop();
  const FlushToZero mode;
  const Stopwatch watch(cpu_time_ ? Time::Process : Time::Wall);
  const Mesh& mesh = scene_->mesh();
  const std::vector<Corners>& triangles = kept_.empty() ? mesh.triangles : kept_;
  handles_->scene = rtcNewScene(handles_->device);
  rtcSetSceneBuildQuality(handles_->scene, low_quality ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(handles_->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  const RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                             sizeof(Vector), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0, sizeof(Corners),
                             triangles.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(handles_->scene);
  return watch.milliseconds();
}

RTCSceneTy* Embree::hierarchy() const noexcept { return handles_->scene; }

void Embree::for_each(int count, const std::function<void(int)>& task) const {
  const auto run = [&](int i) {
    const FlushToZero mode;
    task(i);
  };
  if (threads_ == 1) {
    for (int i = 0; i < count; ++i) run(i);
  } else {
    handles_->arena->execute([&] { tbb::parallel_for(0, count, run); });
  }
}

Phases Embree::trace(const Rays& rays, const std::vector<Light>& lights, const EmbreeWay& way, Answer& answer) const {
  const std::uint32_t* face_of = kept_.empty() ? nullptr : scene_->kept_faces().data();
  std::atomic<double> camera_ms{0}, shade_ms{0};
  const Stopwatch watch(cpu_time_ ? Time::Process : Time::Wall);
  for_each(rays.tile_count(), [&](int number) {
    static thread_local TileTracer tracer;
    const Stopwatch tile_watch(cpu_time_ ? Time::Thread : Time::Wall);
    tracer.see(handles_->scene, rays, number, way, width_, face_of, answer);
    const double seen_ms = tile_watch.milliseconds();
    tracer.ask_lights(handles_->scene, lights, way, width_, answer.light_bytes());
    tracer.write_lights(answer);
    camera_ms.fetch_add(seen_ms);
    shade_ms.fetch_add(tile_watch.milliseconds() - seen_ms);
  });
  return {camera_ms / threads_, 0, shade_ms / threads_, watch.milliseconds()};
}

FaceId Embree::first_face(const Vector& from, const Vector& way) const {
  RTCRayHit query{};
  query.ray = {from.x, from.y, from.z, 0, way.x, way.y, way.z, 0, 1 - kShort, 0xffffffffu, 0, 0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(handles_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNoFace;
  return static_cast<FaceId>(kept_.empty() ? query.hit.primID : scene_->kept_faces()[query.hit.primID]);
}

Opponents calibrate(Embree& embree, const Rays& rays, const std::vector<Light>& lights) {
  constexpr int kTries = 2;
  Answer answer(rays.columns(), rays.rows(), static_cast<int>(lights.size()));
  Opponents best;
  double best_cold = std::numeric_limits<double>::infinity(), best_warm = best_cold;
  for (const bool low : {true, false}) {
    for (const bool robust : {false, true}) {
      const double build_ms = std::min(embree.build(low, robust), embree.build(low, robust));
      double camera_ms[2], shadow_ms[5];
      std::fill(camera_ms, camera_ms + 2, std::numeric_limits<double>::infinity());
      std::fill(shadow_ms, shadow_ms + 5, std::numeric_limits<double>::infinity());
      for (int k = 0; k < 5 * kTries; ++k) {
        const EmbreeWay way{low, robust, EmbreeWay::Camera(k % 2), EmbreeWay::Shadow(k % 5)};
        const Phases phases = embree.trace(rays, lights, way, answer);
        camera_ms[k % 2] = std::min(camera_ms[k % 2], phases.camera);
        shadow_ms[k % 5] = std::min(shadow_ms[k % 5], phases.shade);
      }
      const auto camera = std::min_element(camera_ms, camera_ms + 2),
                 shadow = std::min_element(shadow_ms, shadow_ms + 5);
      const EmbreeWay way{low, robust, EmbreeWay::Camera(camera - camera_ms), EmbreeWay::Shadow(shadow - shadow_ms)};
      const double warm_ms = *camera + *shadow;
      if (warm_ms < best_warm) best_warm = warm_ms, best.warm = way;
      if (warm_ms + build_ms < best_cold) best_cold = warm_ms + build_ms, best.cold = way;
    }
  }
  embree.drop();
  return best;
}

}  // namespace facemap::bench
