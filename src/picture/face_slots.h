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
    planes.count = 0;
    std::uint32_t last = kNoOwnFace;
    std::int64_t slot = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (face_ids[i] != last) {
        last = face_ids[i];
        slot = slot_of(last);
      }
      slots[i] = slot;
    }
  }

  simd::PlaneBatch planes;
  std::uint32_t faces[simd::kSeenBatch];

 private:
  static constexpr std::uint32_t kRecent = 256;

  std::int64_t slot_of(std::uint32_t face) {
    std::uint16_t& recent = recent_[face % kRecent];
    if (recent < planes.count && faces[recent] == face) return recent;
    recent = static_cast<std::uint16_t>(planes.count);
    add(face);
    return recent;
  }

  void add(std::uint32_t face) {
    const std::size_t slot = planes.count++;
    faces[slot] = face;
    const Corners& corners = mesh_.triangles[face];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector& v = mesh_.positions[corners[k]];
      planes.corners[3 * k][slot] = v.x;
      planes.corners[3 * k + 1][slot] = v.y;
      planes.corners[3 * k + 2][slot] = v.z;
    }
  }

  const Mesh& mesh_;
  std::uint16_t recent_[kRecent] = {};
};

}  // namespace facemap
