#include <facemap/error.h>
#include <facemap/parallel_light.h>
#include <facemap/visibility.h>

#include <algorithm>
#include <cmath>

#include "parallel/executor.h"
#include "simd/floating_point_mode.h"
#include "visibility/target_points.h"
#include "visibility/told_progress.h"

namespace facemap {
namespace {

// A task's points where points are shared out: whole bytes of a row.
constexpr std::size_t kFewestPoints = 1024;
static_assert(kFewestPoints % 8 == 0);

// A map is made for these points alone: about one texel a point, within these. With fewer points than texels most of
// its time goes into lists that nobody reads.
constexpr double kFewestTexels = 32, kMostTexels = 2048;  // a side

// 0: what suits the faces, which is enough for any number of points.
int texels_for(std::size_t points, std::size_t faces) {
  const double by_points = std::clamp(std::sqrt(static_cast<double>(points)), kFewestTexels, kMostTexels);
  return points < faces ? static_cast<int>(by_points) : 0;
}

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

class Asking {
 public:
  Asking(const Scene& scene, std::span<const Vector> directions, const Viewpoint::Targets& targets,
         std::span<std::uint8_t> bits, const VisibilityOptions& options, const Viewpoint::Progress& progress)
      : scene_(scene),
        directions_(directions),
        targets_(targets),
        row_(visibility_row_bytes(targets.points.size())),
        bits_(bits),
        options_(options),
        told_(progress, directions.size() * targets.points.size()) {}

  /// The first directions one after the other, their points by all threads, and then the others side by side, as many
  /// maps at a time as there is memory for: the first one says how much a map takes.
  void run() {
    const Executor executor(options_.threads);
    const auto threads = static_cast<std::size_t>(executor.threads());
    const std::size_t others = directions_.size() - 1;
    const std::size_t alone = 1 + (others < threads ? others : others % threads);
    std::size_t map_bytes = 0;
    for (std::size_t d = 0; d < alone; ++d) map_bytes = std::max(map_bytes, ask_shared(d, executor));
    const std::size_t at_once = options_.memory == 0 ? threads : std::clamp(options_.memory / map_bytes, kOne, threads);
    if (at_once == threads) return ask_rest(alone, executor);
    ask_rest(alone, Executor(static_cast<int>(at_once)));
  }

 private:
  static constexpr std::size_t kOne = 1;

  ParallelLight light_of(std::size_t direction) const {
    return {scene_,
            -directions_[direction],
            {.texels = texels_for(targets_.points.size(), scene_.face_count()),
             .cut_outs = options_.cut_outs,
             .max_texture_pixels = options_.max_texture_pixels}};
  }

  // Bytes of its map.
  std::size_t ask_shared(std::size_t direction, const Executor& executor) {
    const ParallelLight light = light_of(direction);
    const std::size_t points = targets_.points.size();
    executor.for_each(points / kFewestPoints + (points % kFewestPoints != 0), [&](std::size_t piece, int) {
      const std::size_t first = piece * kFewestPoints;
      ask(light, direction, first, std::min(first + kFewestPoints, points));
    });
    return light.memory_bytes() + 1;
  }

  void ask_rest(std::size_t first, const Executor& executor) {
    executor.for_each(directions_.size() - first, [&](std::size_t i, int) {
      const ParallelLight light = light_of(first + i);
      const std::size_t points = targets_.points.size();
      for (std::size_t p = 0; p < points; p += kFewestPoints) {
        ask(light, first + i, p, std::min(p + kFewestPoints, points));
      }
    });
  }

  // Points `first`, a multiple of 8, up to `last`.
  void ask(const ParallelLight& light, std::size_t direction, std::size_t first, std::size_t last) {
    std::uint8_t* const row = bits_.data() + direction * row_;
    for (std::size_t begin = first; begin < last; begin += 8) {
      unsigned byte = 0;
      for (std::size_t p = begin; p < std::min(begin + 8, last); ++p) {
        const FaceId own = targets_.faces.empty() ? kNoFace : targets_.faces[p];
        if (!light.is_blocked(targets_.points[p], own, targets_.tolerance)) byte |= 1u << (p % 8);
      }
      row[begin / 8] = static_cast<std::uint8_t>(byte);
    }
    told_.add(last - first);
  }

  const Scene& scene_;
  const std::span<const Vector> directions_;
  const Viewpoint::Targets& targets_;
  const std::size_t row_;
  const std::span<std::uint8_t> bits_;
  const VisibilityOptions& options_;
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
  if (!bits.empty()) Asking(scene, directions, targets, bits, options, progress).run();
}

}  // namespace facemap
