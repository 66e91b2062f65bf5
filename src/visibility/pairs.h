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

/// Many origins and many points at once, of a scene whose faces are all solid. Visibility is mutual: either the origins
/// or the points are taken as hubs, whichever is less work.
class Pairs {
 public:
  /// All points must be finite, and targets.faces faces of the scene.
  Pairs(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
        const Executor& executor);

  /// Writes rows of visibility(). `memory`: as VisibilityOptions. Calls report(n) after each n pairs more.
  void run(std::span<std::uint8_t> bits, std::size_t memory, const std::function<void(std::size_t)>& report);

 private:
  enum class Hubs { Origins, Points };

  // What a worker needs for itself.
  struct Worker {
    HubPass pass;
    std::vector<Blocker> blockers;
    std::vector<std::uint8_t> bits;  // of eight hubs, a byte a segment
  };

  std::span<const Vector> hubs(Hubs kind) const { return kind == Hubs::Origins ? origins_ : targets_.points; }
  std::span<const Vector> ends(Hubs kind) const { return kind == Hubs::Origins ? targets_.points : origins_; }
  std::uint32_t own_place(std::size_t point) const;

  std::size_t piece_of(Hubs kind, std::size_t memory) const;
  Hubs choose(std::size_t memory);
  double work_of(Hubs kind, std::size_t samples, std::size_t memory);
  void set_ends(Hubs kind, std::size_t first, std::size_t last);
  void ask(Hubs kind, std::size_t hub, Worker& worker) const;
  void ask_origins(std::size_t first, std::span<std::uint8_t> bits, const std::function<void(std::size_t)>& report);
  void ask_points(std::size_t first, std::span<std::uint8_t> bits, const std::function<void(std::size_t)>& report);

  const Scene& scene_;
  std::span<const Vector> origins_;
  const Viewpoint::Targets& targets_;
  const Executor& executor_;
  FacePacks packs_;
  ScaledPoints ends_;                 // of the segments, neighbours side by side
  std::vector<std::uint32_t> order_;  // which of the piece each is
  std::vector<Worker> workers_;
};

}  // namespace facemap
