#pragma once

#include <facemap/mesh.h>

#include <cstdint>

#include "simd/seen_planes.h"

namespace facemap {

/// The faces of a batch of points, each held once as long as equal ones follow closely.
class FaceSlots {
 public:
  explicit FaceSlots(const Mesh& mesh) : mesh_(mesh) {}

  /// Starts anew with the faces of a batch: slots[i] is the place of face_ids[i] in `planes`, where its corners stand.
  void assign(const std::uint32_t* face_ids, std::size_t count, std::int64_t* slots) {
    find_runs(face_ids, count);
    place_runs();
    for (std::size_t i = 0; i < count; ++i) slots[i] = slot_of_run_[run_of_[i]];
    simd::load_corners(mesh_.triangles.data()->data(), &mesh_.positions.data()->x, faces, planes);
  }

  simd::PlaneBatch planes;
  std::uint32_t faces[simd::kSeenBatch] = {};

 private:
  static constexpr std::uint32_t kRecent = 256;

  // No branches here: where the next face begins, and whether it has been seen before, is hard to predict.
  void find_runs(const std::uint32_t* face_ids, std::size_t count) {
    std::uint32_t run = 0, last = count == 0 ? 0 : face_ids[0];
    for (std::size_t i = 0; i < count; ++i) {
      run += face_ids[i] != last;
      last = face_ids[i];
      face_of_run_[run] = last;
      run_of_[i] = static_cast<std::uint8_t>(run);
    }
    runs_ = count == 0 ? 0 : run + 1;
  }

  void place_runs() {
    std::uint32_t found = 0;
    for (std::uint32_t run = 0; run < runs_; ++run) {
      const std::uint32_t face = face_of_run_[run];
      std::uint16_t& recent = recent_[face % kRecent];
      const std::uint32_t is_known = std::uint32_t{recent < found} & std::uint32_t{faces[recent] == face};
      const std::uint32_t slot = found ^ ((found ^ recent) & (0 - is_known));
      faces[found] = face;
      found += 1 - is_known;
      recent = static_cast<std::uint16_t>(slot);
      slot_of_run_[run] = static_cast<std::uint16_t>(slot);
    }
    planes.count = found;
  }

  const Mesh& mesh_;
  std::uint16_t recent_[kRecent] = {};
  std::size_t runs_ = 0;
  std::uint32_t face_of_run_[simd::kSeenBatch];
  std::uint16_t slot_of_run_[simd::kSeenBatch];
  std::uint8_t run_of_[simd::kSeenBatch];
};
static_assert(simd::kSeenBatch == 256);

}  // namespace facemap
