#pragma once

#include <embree3/rtcore.h>
#include <facemap/renderer.h>

#include <cstdint>
#include <vector>

#include "facemap_bench_embree.h"
#include "facemap_bench_question.h"
#include "facemap_bench_ray_packets.h"

namespace facemap::bench {

/// One tile's rays through Embree, from directions to ids and masks. One a thread; its memory is the tile's alone.
class TileTracer {
 public:
  /// Rays from the camera: ids go to `answer`, points and normals stay here.
  void see(RTCScene scene, const Rays& rays, int tile, const EmbreeWay& way, int width, const std::uint32_t* face_of,
           Answer& answer);

  /// Rays from every light to the points whose faces the light is in front of.
  void ask_lights(RTCScene scene, const std::vector<Light>& lights, const EmbreeWay& way, int width, int light_bytes);

  void write_lights(Answer& answer) const;

 private:
  static constexpr int kCount = kTile * kTile;
  static constexpr int kRun = 4;  // samples side by side in a block
  struct alignas(64) Floats {
    float at[kCount];
  };

  template <class Packet>
  void see_packets(RTCScene scene, const float* directions, const Vector& origin, RTCIntersectContext& context);
  template <class Packet>
  void ask_packets(RTCScene scene, const Vector& light, RTCIntersectContext& context);
  template <class Packet>
  void ask_packed(RTCScene scene, const Vector& light, RTCIntersectContext& context);
  void ask_streams(RTCScene scene, const Vector& light, RTCIntersectContext& context);
  template <class Packet>
  void ask(RTCScene scene, const Vector& light, EmbreeWay::Shadow shadow, RTCIntersectContext& context);
  int list_facing();

  /// Copies a run of a block's row, `values` values a sample, to where it belongs in the picture.
  template <class Value>
  void copy_run(const Value* from, Value* picture, int first, int values, const Answer& answer) const;

  Floats x_, y_, z_;     // points
  Floats nx_, ny_, nz_;  // normals turned towards the camera; 0 where no face is seen
  alignas(64) std::int32_t prims_[kCount];
  alignas(64) std::int32_t facing_[kCount];  // -1: the light is in front of the face
  alignas(64) std::int32_t lit_[kCount];     // -1: and nothing between
  std::uint16_t listed_[kCount + kBlock];
  std::vector<std::uint8_t> masks_;
  int light_bytes_ = 0;
  int left_ = 0, top_ = 0;
};

}  // namespace facemap::bench
