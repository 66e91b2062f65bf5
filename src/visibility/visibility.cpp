#include <facemap/error.h>
#include <facemap/visibility.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "simd/floating_point_mode.h"
#include "visibility/pairs.h"
#include "visibility/target_points.h"
#include "visibility/told_progress.h"

namespace facemap {
namespace {

bool are_finite(std::span<const Vector> points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Vector& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

void check(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets, std::size_t bytes,
           const VisibilityOptions& options) {
  if (options.threads < 0) throw Error("visibility takes 0 threads or more");
  if (bytes != origins.size() * visibility_row_bytes(targets.points.size())) {
    throw Error("visibility needs as many bytes as its rows together");
  }
  if (!are_finite(origins)) throw Error("an origin is not finite");
  check_targets(targets);
  check_points(scene, targets);
}

// A viewpoint an origin: for faces with holes, and for tolerances.
void ask_one_by_one(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
                    std::span<std::uint8_t> bits, const VisibilityOptions& options, ToldProgress& told) {
  const std::size_t points = targets.points.size(), row = visibility_row_bytes(points);
  std::vector<std::uint8_t> answers(points);
  for (std::size_t i = 0; i < origins.size(); ++i) {
    Viewpoint(scene, origins[i], {options.threads, options.cut_outs, options.max_texture_pixels})
        .visible(targets, answers);
    std::uint8_t* out = bits.data() + i * row;
    std::fill(out, out + row, std::uint8_t{0});
    for (std::size_t j = 0; j < points; ++j) out[j / 8] = static_cast<std::uint8_t>(out[j / 8] | answers[j] << (j % 8));
    told.add(points);
  }
}

}  // namespace

void visibility(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
                std::span<std::uint8_t> bits, const VisibilityOptions& options, const Viewpoint::Progress& progress) {
  const FloatingPointMode mode;
  check(scene, origins, targets, bits.size(), options);
  if (bits.empty()) return;
  ToldProgress told(progress, origins.size() * targets.points.size());
  const MapFaces faces = map_faces(scene, options.cut_outs, options.max_texture_pixels);
  if (faces.has_cut_outs() || targets.tolerance > 0) {
    return ask_one_by_one(scene, origins, targets, bits, options, told);
  }
  const Executor executor(options.threads);
  Pairs(faces.solid(), origins, targets, executor).run(bits, options.memory, [&](std::size_t pairs) {
    told.add(pairs);
  });
}

}  // namespace facemap
