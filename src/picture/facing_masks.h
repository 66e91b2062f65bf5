#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "picture/face_slots.h"
#include "picture/light_places.h"

namespace facemap {

/// Which lights are strictly on the camera's side of a face. Exact. Working memory of one thread.
class FacingMasks {
 public:
  /// All must outlive it.
  FacingMasks(const Scene& scene, const Vector& camera, const LightPlaces& lights);

  /// Bytes of a mask: ceil(lights / 8).
  std::size_t stride() const { return (lights_.size() + 7) / 8; }

  /// Writes the masks of `count` points, point i on the face at slots[i] of `faces`, whose planes have been set up.
  void store(const FaceSlots& faces, const std::int64_t* slots, std::size_t count, std::uint8_t* masks);

 private:
  void find_facing(const FaceSlots& faces, std::size_t byte);
  bool is_facing(std::uint32_t face, std::size_t light);

  const Scene& scene_;
  Vector camera_;
  const LightPlaces& lights_;
  std::int32_t facing_[simd::kSeenBatch], unsure_[simd::kSeenBatch];
  std::unordered_map<std::uint64_t, bool> known_;  // by face and light, where doubles left it open
};

}  // namespace facemap
