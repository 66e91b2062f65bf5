#include <facemap/error.h>
#include <facemap/visibility.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "simd/floating_point_mode.h"
#include "visibility/pairs.h"

namespace facemap {
namespace {

bool are_finite(std::span<const Vector> points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Vector& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

void check(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets, std::size_t bytes,
           const VisibilityOptions& options) {
  const std::size_t points = targets.points.size();
  if (options.threads < 0) throw Error("visibility takes 0 threads or more");
  if (bytes != origins.size() * visibility_row_bytes(points)) {
    throw Error("visibility needs as many bytes as its rows together");
  }
  if (!are_finite(origins)) throw Error("an origin is not finite");
  if (!are_finite(targets.points)) throw Error("a point is not finite");
  if (!(targets.tolerance >= 0) || !std::isfinite(targets.tolerance)) throw Error("a tolerance is 0 or more");
  if (!targets.faces.empty() && targets.faces.size() != points) throw Error("visibility takes no face or one a point");
  for (const FaceId face : targets.faces) {
    if (face != kNoFace && (face < 0 || static_cast<std::size_t>(face) >= scene.face_count())) {
      throw Error("a point lies on face " + std::to_string(face) + ", and there are " +
                  std::to_string(scene.face_count()));
    }
  }
}

// Tells the caller how many of all pairs are done, and throws Error if it wants no more.
class Report {
 public:
  Report(const Viewpoint::Progress& progress, std::size_t origins, std::size_t points)
      : progress_(progress), all_(static_cast<double>(origins) * static_cast<double>(points)) {}

  void add(std::size_t pairs) {
    if (!progress_) return;
    const std::scoped_lock lock(mutex_);
    done_ += static_cast<double>(pairs);
    if (is_stopped_ || !progress_(done_ / all_)) {
      is_stopped_ = true;
      throw Error("stopped");
    }
  }

 private:
  const Viewpoint::Progress& progress_;
  const double all_;
  std::mutex mutex_;
  double done_ = 0;
  bool is_stopped_ = false;
};

// A viewpoint an origin: for faces with holes, and for tolerances.
void ask_one_by_one(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
                    std::span<std::uint8_t> bits, const VisibilityOptions& options, Report& report) {
  const std::size_t points = targets.points.size(), row = visibility_row_bytes(points);
  std::vector<std::uint8_t> answers(points);
  for (std::size_t i = 0; i < origins.size(); ++i) {
    Viewpoint(scene, origins[i], {options.threads, options.cut_outs, options.max_texture_pixels})
        .visible(targets, answers);
    std::uint8_t* out = bits.data() + i * row;
    std::fill(out, out + row, std::uint8_t{0});
    for (std::size_t j = 0; j < points; ++j) out[j / 8] = static_cast<std::uint8_t>(out[j / 8] | answers[j] << (j % 8));
    report.add(points);
  }
}

}  // namespace

void visibility(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
                std::span<std::uint8_t> bits, const VisibilityOptions& options, const Viewpoint::Progress& progress) {
  const FloatingPointMode mode;
  check(scene, origins, targets, bits.size(), options);
  if (bits.empty()) return;
  Report report(progress, origins.size(), targets.points.size());
  const MapFaces faces = map_faces(scene, options.cut_outs, options.max_texture_pixels);
  if (faces.has_cut_outs() || targets.tolerance > 0) {
    return ask_one_by_one(scene, origins, targets, bits, options, report);
  }
  const Executor executor(options.threads);
  Pairs(faces.solid(), origins, targets, executor).run(bits, options.memory, [&](std::size_t pairs) {
    report.add(pairs);
  });
}

}  // namespace facemap
