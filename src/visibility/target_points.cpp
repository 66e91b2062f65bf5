#include "visibility/target_points.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "math/power_of_two.h"
#include "simd/step_points.h"

namespace facemap {
namespace {

constexpr std::size_t kFewestPoints = 16384;  // a task

// Coordinates are rounded to steps: at most 2^30 of them from the middle.
constexpr double kMostSteps = 0x1p30;

// Half a step for each coordinate, sqrt(3) / 2 < 0.8661 for three; a point's difference from the middle is rounded by
// 2^-53 of at most 2^30 steps.
constexpr double kRoundingError = 0.8662;  // steps

// A power of two, above 0, of which `reach` is at most 2^30.
double step_for(double reach) { return reach > 0 ? 2 / inverse_power_of_two(reach / kMostSteps) : 0x1p-1000; }

const float* floats_of(std::span<const Vector> points) { return &points[0].x; }

// At least one point. Throws Error if one is not finite.
simd::PointBox box_of(std::span<const Vector> points) {
  const simd::PointBox box = simd::box_of_points(floats_of(points), points.size());
  if (!box.is_finite) throw Error("a point is not finite");
  return box;
}

simd::PointBox box_of(std::span<const Vector> points, const Executor& executor) {
  simd::PointBox all{};
  bool is_first = true;
  std::mutex merging;
  for_ranges(executor, points.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    const simd::PointBox box = box_of(points.subspan(first, last - first));
    const std::scoped_lock lock(merging);
    if (std::exchange(is_first, false)) all = box;
    for (int k = 0; k < 3; ++k) {
      all.lower[k] = std::min(all.lower[k], box.lower[k]);
      all.upper[k] = std::max(all.upper[k], box.upper[k]);
    }
  });
  return all;
}

// Room for points in a box.
void start(const simd::PointBox& box, std::span<const Vector> of, AskedPoints& points) {
  const std::size_t count = of.size();
  double reach = 0;
  for (int k = 0; k < 3; ++k) {
    points.origin[k] = 0.5 * (double{box.lower[k]} + double{box.upper[k]});
    reach = std::max({reach, double{box.upper[k]} - points.origin[k], points.origin[k] - double{box.lower[k]}});
  }
  points.step = step_for(reach);
  points.error = kRoundingError * points.step;
  for (auto* coordinates : {&points.x, &points.y, &points.z}) coordinates->resize(count);
  points.faces.resize(count);
  points.given = floats_of(of);
}

std::uint32_t own_face(const Scene& scene, const Viewpoint::Targets& targets, std::size_t point) {
  const FaceId face = targets.faces[point];
  if (face == kNoFace) return kNoOwnFace;
  if (face < 0 || static_cast<std::size_t>(face) >= scene.face_count()) {
    throw Error("point " + std::to_string(point) + " lies on face " + std::to_string(face) + ", and there are " +
                std::to_string(scene.face_count()));
  }
  return static_cast<std::uint32_t>(face);
}

// Targets `first` up to `last` to places from `at` on.
void fill(const Scene& scene, const Viewpoint::Targets& targets, std::size_t first, std::size_t last, std::size_t at,
          AskedPoints& points) {
  const simd::PointSteps steps{{points.origin.x, points.origin.y, points.origin.z}, 1 / points.step};
  simd::step_points(floats_of(targets.points.subspan(first)), last - first, steps, &points.x[at], &points.y[at],
                    &points.z[at]);
  if (targets.faces.empty()) {
    std::fill_n(&points.faces[at], last - first, kNoOwnFace);
  } else {
    for (std::size_t i = first; i < last; ++i) points.faces[at + i - first] = own_face(scene, targets, i);
  }
}

}  // namespace

AskedPoints points_with_room(std::size_t count) {
  const auto pages = std::make_shared<SharedPages>(4 * SharedPages::room_for<std::int32_t>(count));
  AskedPoints points;
  for (auto* coordinates : {&points.x, &points.y, &points.z}) {
    *coordinates = UnsetVector<std::int32_t>(UnsetAllocator<std::int32_t>(pages));
  }
  points.faces = UnsetVector<std::uint32_t>(UnsetAllocator<std::uint32_t>(pages));
  return points;
}

AskedPoints asked_points(const Scene& scene, const Viewpoint::Targets& targets, std::size_t first, std::size_t last,
                         const Executor& executor) {
  if (first == last) return {};
  AskedPoints points = points_with_room(last - first);
  const std::span<const Vector> some = targets.points.subspan(first, last - first);
  start(box_of(some, executor), some, points);
  for_ranges(executor, last - first, kFewestPoints, [&](std::size_t begin, std::size_t end, int) {
    fill(scene, targets, first + begin, first + end, begin, points);
  });
  return points;
}

void put_points(const Scene& scene, const Viewpoint::Targets& targets, std::size_t first, std::size_t last,
                AskedPoints& points) {
  if (first == last) return;
  const std::span<const Vector> some = targets.points.subspan(first, last - first);
  start(box_of(some), some, points);
  fill(scene, targets, first, last, 0, points);
}

void check_targets(const Viewpoint::Targets& targets) {
  if (!targets.faces.empty() && targets.faces.size() != targets.points.size()) {
    throw Error("targets have no faces or as many as points");
  }
  if (!(targets.tolerance >= 0) || !std::isfinite(targets.tolerance)) {
    throw Error("the tolerance of targets is 0 or more, and finite");
  }
}

void check_points(const Scene& scene, const Viewpoint::Targets& targets) {
  if (!targets.points.empty()) box_of(targets.points);
  for (std::size_t i = 0; i < targets.faces.size(); ++i) own_face(scene, targets, i);
}

}  // namespace facemap
