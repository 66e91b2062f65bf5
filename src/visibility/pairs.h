#pragma once

#include <facemap/visibility.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "parallel/executor.h"
#include "visibility/face_packs.h"
#include "visibility/hub_pass.h"

namespace facemap {

/// Many origins and many points at once, of a scene whose faces are all solid.
class Pairs {
 public:
  /// All points must be finite, and targets.faces faces of the scene.
  Pairs(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
        const Executor& executor);

  /// Writes rows of visibility(). `memory`: as VisibilityOptions. Calls report(n) after each n pairs more.
  void run(std::span<std::uint8_t> bits, std::size_t memory, const std::function<void(std::size_t)>& report);

 private:
  void run_piece(std::size_t first, std::size_t last, std::span<std::uint8_t> bits,
                 const std::function<void(std::size_t)>& report);
  void set_points(std::size_t first, std::size_t last);
  void ask_origin(std::size_t origin, std::size_t worker);

  const Scene& scene_;
  std::span<const Vector> origins_;
  const Viewpoint::Targets& targets_;
  const Executor& executor_;
  FacePacks packs_;
  ScaledPoints points_;             // of a piece
  std::vector<std::uint32_t> all_;  // their numbers
  std::vector<HubPass> passes_;     // one a worker
  std::vector<std::vector<Blocker>> blockers_;
};

}  // namespace facemap
