#include "picture/facing_masks.h"

#include <algorithm>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "math/parallel_signs.h"

namespace facemap {

FacingMasks::FacingMasks(const Scene& scene, const Vector& camera, const LightPlaces& lights)
    : scene_(scene), camera_(camera), lights_(lights) {}

void FacingMasks::store(const FaceSlots& faces, const std::int64_t* slots, std::size_t count, std::uint8_t* masks) {
  const std::size_t bytes = stride();
  const std::int32_t* facing = facing_;
  for (std::size_t byte = 0; byte < bytes; ++byte) {
    find_facing(faces, byte);
    for (std::size_t i = 0; i < count; ++i) masks[i * bytes + byte] = static_cast<std::uint8_t>(facing[slots[i]]);
  }
}

// The eight lights of a mask's byte.
void FacingMasks::find_facing(const FaceSlots& faces, std::size_t byte) {
  const std::size_t first = byte * 8, count = std::min<std::size_t>(8, lights_.size() - first);
  float places[8][3];
  unsigned parallel = 0;
  for (std::size_t l = 0; l < count; ++l) {
    for (int axis = 0; axis < 3; ++axis) places[l][axis] = lights_.at[first + l][axis];
    parallel |= unsigned{lights_.is_parallel[first + l]} << l;
  }
  simd::find_facing(faces.planes, places, static_cast<int>(count), parallel, facing_, unsure_);
  for (std::size_t slot = 0; slot < faces.planes.count; ++slot) {
    if (unsure_[slot] == 0) continue;
    for (std::size_t l = 0; l < count; ++l) {
      if ((unsure_[slot] >> l & 1) != 0 && is_facing(faces.faces[slot], first + l)) facing_[slot] |= 1 << l;
    }
  }
}

// Once for each face and light: a large face in a light's plane is asked about in many batches.
bool FacingMasks::is_facing(std::uint32_t face, std::size_t light) {
  const auto [entry, is_new] = known_.try_emplace(static_cast<std::uint64_t>(face) * lights_.size() + light, false);
  if (is_new) {
    const Triangle triangle = triangle_of(scene_, face);
    const Vector& at = lights_.at[light];
    const int side_of_light = lights_.is_parallel[light] != 0 ? side_along(triangle, at) : side(triangle, at);
    entry->second = side(triangle, camera_) * side_of_light > 0;
  }
  return entry->second;
}

}  // namespace facemap
