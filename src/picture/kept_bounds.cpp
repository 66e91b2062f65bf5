#include "picture/kept_bounds.h"

#include <algorithm>

#include "picture/ask_lists.h"
#include "scene/face_neighbours.h"

namespace facemap {

void KeptBounds::make(const Scene& scene, const LightPlaces& lights, const ClosedParts* closed,
                      const std::vector<std::uint8_t>& outside_camera, const Executor& executor) {
  outside_camera_ = outside_camera;
  work_.resize(static_cast<std::size_t>(executor.threads()));
  std::vector<std::optional<LightBounds>> made(lights.size());
  const std::vector<FaceNeighbours> neighbours = find_face_neighbours(scene);
  executor.for_each(lights.size(), [&](std::size_t l, int) {
    if (lights.is_parallel[l] != 0) return;
    const Vector& light = lights.at[l];
    std::vector<std::uint8_t> skippable;
    if (closed != nullptr) skippable = closed->skippable_entries(scene, outside_camera, light);
    const bool wants_lists = can_ask_lists(scene, light, 0);  // else no picture's points will ask them
    made[l] = LightBounds::find(scene, light, skippable.empty() ? nullptr : skippable.data(), neighbours, wants_lists);
  });
  of_lights_ = std::move(made);
}

const LightBounds* KeptBounds::of(std::size_t light, const std::vector<std::uint8_t>& outside_camera) const {
  return are_made() && of_lights_[light] && outside_camera == outside_camera_ ? &*of_lights_[light] : nullptr;
}

void KeptBounds::tidy() {
  const bool has_any = std::any_of(of_lights_.begin(), of_lights_.end(), [](const auto& of) { return of.has_value(); });
  if (!has_any) work_ = std::vector<DecidedPoints>(work_.size());
}

std::size_t KeptBounds::memory_bytes() const noexcept {
  std::size_t bytes = 0;
  for (const auto& bounds : of_lights_) bytes += bounds ? bounds->memory_bytes() : 0;
  for (const DecidedPoints& work : work_) bytes += work.memory_bytes();
  return bytes;
}

}  // namespace facemap
