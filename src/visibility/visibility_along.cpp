#include <facemap/error.h>
#include <facemap/parallel_light.h>
#include <facemap/visibility.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "simd/floating_point_mode.h"
#include "visibility/parallel_pass.h"
#include "visibility/target_points.h"
#include "visibility/told_progress.h"

namespace facemap {
namespace {

// Targets that a task asks about: so many that what is done for each face is little beside them, whole bytes of a row.
constexpr std::size_t kPiece = std::size_t{1} << 17;

// The same where a map is asked.
constexpr std::size_t kMapPiece = 1024;
static_assert(kPiece % 8 == 0 && kMapPiece % 8 == 0);

// A map is made in the time in which a pass asks about so many targets a face, and is then asked in less:
// docs/algorithm.md, 2.7.
constexpr std::size_t kTargetsForAMap = 2;

bool is_direction(const Vector& d) {
  return std::isfinite(double{d.x} + d.y + d.z) && (d.x != 0 || d.y != 0 || d.z != 0);
}

void check(std::span<const Vector> directions, const Viewpoint::Targets& targets, std::size_t bytes,
           const VisibilityOptions& options) {
  if (options.threads < 0) throw Error("visibility takes 0 threads or more");
  if (bytes != directions.size() * visibility_row_bytes(targets.points.size())) {
    throw Error("visibility needs as many bytes as its rows together");
  }
  if (!std::all_of(directions.begin(), directions.end(), is_direction)) {
    throw Error("a direction is zero or not finite");
  }
}

void pack(std::span<const std::uint8_t> visible, std::uint8_t* out) {
  for (std::size_t begin = 0; begin < visible.size(); begin += 8) {
    unsigned byte = 0;
    for (std::size_t i = begin; i < std::min(begin + 8, visible.size()); ++i) byte |= unsigned{visible[i]} << (i % 8);
    out[begin / 8] = static_cast<std::uint8_t>(byte);
  }
}

/// All targets, a piece after the other, for each direction.
class Asking {
 public:
  Asking(std::span<const Vector> directions, const Viewpoint::Targets& targets, std::span<std::uint8_t> bits,
         const Viewpoint::Progress& progress)
      : directions_(directions),
        targets_(targets),
        pieces_((targets.points.size() + kPiece - 1) / kPiece),
        bits_(bits),
        told_(progress, directions.size() * targets.points.size()) {}

  /// Shadows without a map: any scene whose faces have no holes. As many workers as there is memory for.
  void ask_by_passes(const Scene& scene, const VisibilityOptions& options) {
    const std::size_t bytes = ParallelPass::bytes_for(scene, std::min(targets_.points.size(), kPiece)) + 1;
    const Executor executor(options.threads);
    const auto threads = static_cast<std::size_t>(executor.threads());
    const std::size_t at_once = workers_for(options.memory, bytes, threads);
    if (at_once == threads) return ask_by_passes(scene, executor);
    ask_by_passes(scene, Executor(static_cast<int>(at_once)));
  }

  /// A map a direction, which knows holes. The first directions one after the other, their targets by all threads; the
  /// others side by side, as many maps at a time as there is memory for: the first ones say how much a map takes.
  void ask_by_maps(const Scene& scene, const VisibilityOptions& options) {
    const Executor executor(options.threads);
    const auto threads = static_cast<std::size_t>(executor.threads());
    const std::size_t others = directions_.size() - 1;
    const std::size_t alone = 1 + (others < threads ? others : others % threads);
    std::size_t bytes = 1;
    for (std::size_t d = 0; d < alone; ++d) bytes = std::max(bytes, ask_map(scene, options, d, executor));
    const Executor one(1);
    const auto ask_others = [&](const Executor& all) {
      all.for_each(directions_.size() - alone, [&](std::size_t i, int) { ask_map(scene, options, alone + i, one); });
    };
    const std::size_t at_once = workers_for(options.memory, bytes, threads);
    if (at_once == threads) return ask_others(executor);
    ask_others(Executor(static_cast<int>(at_once)));
  }

 private:
  struct Worker {
    Worker(const Scene& scene, const Viewpoint::Targets& targets) : pass(scene, targets) {}
    ParallelPass pass;
    std::vector<std::uint8_t> visible;
  };

  static std::size_t workers_for(std::size_t memory, std::size_t bytes, std::size_t threads) {
    return memory == 0 ? threads : std::clamp(memory / bytes, std::size_t{1}, threads);
  }

  // Bytes of the map.
  std::size_t ask_map(const Scene& scene, const VisibilityOptions& options, std::size_t direction,
                      const Executor& executor) {
    const ParallelLight light(scene, -directions_[direction],
                              {.cut_outs = options.cut_outs, .max_texture_pixels = options.max_texture_pixels});
    const std::size_t points = targets_.points.size();
    executor.for_each((points + kMapPiece - 1) / kMapPiece, [&](std::size_t piece, int) {
      const std::size_t first = piece * kMapPiece;
      std::uint8_t visible[kMapPiece];
      const std::span<std::uint8_t> some(visible, std::min(kMapPiece, points - first));
      for (std::size_t i = 0; i < some.size(); ++i) {
        const FaceId own = targets_.faces.empty() ? kNoFace : targets_.faces[first + i];
        some[i] = !light.is_blocked(targets_.points[first + i], own, targets_.tolerance);
      }
      pack(some, row(direction) + first / 8);
      told_.add(some.size());
    });
    return light.memory_bytes();
  }

  void ask_by_passes(const Scene& scene, const Executor& executor) {
    std::vector<std::optional<Worker>> workers(static_cast<std::size_t>(executor.threads()));
    executor.for_each(directions_.size() * pieces_, [&](std::size_t task, int w) {
      std::optional<Worker>& worker = workers[static_cast<std::size_t>(w)];
      if (!worker) worker.emplace(scene, targets_);
      const std::size_t d = task / pieces_, first = task % pieces_ * kPiece;
      worker->visible.resize(std::min(kPiece, targets_.points.size() - first));
      worker->pass.run(-directions_[d], first, worker->visible);
      pack(worker->visible, row(d) + first / 8);
      told_.add(worker->visible.size());
    });
  }

  std::uint8_t* row(std::size_t direction) const {
    return bits_.data() + direction * visibility_row_bytes(targets_.points.size());
  }

  const std::span<const Vector> directions_;
  const Viewpoint::Targets& targets_;
  const std::size_t pieces_;
  const std::span<std::uint8_t> bits_;
  ToldProgress told_;
};

}  // namespace

void visibility_along(const Scene& scene, std::span<const Vector> directions, const Viewpoint::Targets& targets,
                      std::span<std::uint8_t> bits, const VisibilityOptions& options,
                      const Viewpoint::Progress& progress) {
  const FloatingPointMode mode;
  check(directions, targets, bits.size(), options);
  check_targets(targets);
  check_points(scene, targets);
  if (bits.empty()) return;
  Asking asking(directions, targets, bits, progress);
  const MapFaces faces = map_faces(scene, options.cut_outs, options.max_texture_pixels);
  const bool is_for_maps = targets.points.size() / kTargetsForAMap > faces.solid().face_count();
  if (faces.has_cut_outs() || is_for_maps) return asking.ask_by_maps(scene, options);
  asking.ask_by_passes(faces.solid(), options);
}

}  // namespace facemap
