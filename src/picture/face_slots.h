#pragma once

#include <facemap/mesh.h>

#include <cstdint>

#include "picture/asked_points.h"
#include "simd/seen_planes.h"

namespace facemap {

/// The faces of a batch of points, each held once as long as equal ones follow closely.
class FaceSlots {
 public:
  explicit FaceSlots(const Mesh& mesh) : mesh_(mesh) {}

  /// Starts anew with the faces of a batch: slots[i] is the place of face_ids[i] in `planes`, where its corners stand.
  void assign(const std::uint32_t* face_ids, std::size_t count, std::int64_t* slots) {
    std::size_t used = 0;
    for (std::size_t i = 0; i < count; ++i) {
      // No branch: which faces are new is hard to foresee.
      const std::uint32_t face = face_ids[i];
      std::uint16_t& recent = recent_[face % kRecent];
      const bool is_known = recent < used && faces[recent] == face;
      const std::size_t slot = is_known ? recent : used;
      faces[slot] = face;
      recent = static_cast<std::uint16_t>(slot);
      slots[i] = static_cast<std::int64_t>(slot);
      used += !is_known;
    }
    planes.count = used;
    place_corners();
  }

  simd::PlaneBatch planes;
  std::uint32_t faces[simd::kSeenBatch];

 private:
  static constexpr std::uint32_t kRecent = 256;

  // In two passes, so that many faces are on their way from memory at a time.
  void place_corners() {
    for (std::size_t slot = 0; slot < planes.count; ++slot) triangles_[slot] = mesh_.triangles[faces[slot]];
    for (std::size_t slot = 0; slot < planes.count; ++slot) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector& v = mesh_.positions[triangles_[slot][k]];
        planes.corners[3 * k][slot] = v.x;
        planes.corners[3 * k + 1][slot] = v.y;
        planes.corners[3 * k + 2][slot] = v.z;
      }
    }
  }

  const Mesh& mesh_;
  std::uint16_t recent_[kRecent] = {};
  Corners triangles_[simd::kSeenBatch];
};

}  // namespace facemap
