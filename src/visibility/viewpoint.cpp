#include <facemap/error.h>
#include <facemap/viewpoint.h>

#include <cmath>

#include "simd/floating_point_mode.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

constexpr std::size_t kFewestRays = 256;  // a task

Viewpoint::Options checked(const Vector& origin, const Viewpoint::Options& options) {
  if (!std::isfinite(origin.x) || !std::isfinite(origin.y) || !std::isfinite(origin.z)) {
    throw Error("the origin of a viewpoint is not finite");
  }
  if (options.threads < 0) throw Error("a viewpoint takes 0 threads or more");
  return options;
}

}  // namespace

void check_size(std::size_t answers, std::size_t questions) {
  if (answers != questions) throw Error("as many answers as questions are needed");
}

Viewpoint::Kept::Kept(const Scene& of, const Vector& at, const Options& wanted)
    : scene(of),
      origin(at),
      options(checked(at, wanted)),
      executor(options.threads),
      faces(map_faces(scene, options.cut_outs, options.max_texture_pixels)) {}

const WholeView& Viewpoint::Kept::whole_view() {
  std::call_once(view_once, [&] { view.emplace(scene, origin, faces); });
  return *view;
}

Viewpoint::Viewpoint(const Scene& scene, const Vector& origin, const Options& options)
    : kept_(std::make_unique<Kept>(scene, origin, options)) {}
Viewpoint::~Viewpoint() = default;
Viewpoint::Viewpoint(Viewpoint&&) noexcept = default;
Viewpoint& Viewpoint::operator=(Viewpoint&&) noexcept = default;

const Scene& Viewpoint::scene() const noexcept { return kept_->scene; }
const Vector& Viewpoint::origin() const noexcept { return kept_->origin; }

void Viewpoint::blocked_by(const Targets&, std::span<FaceId>, const Progress&) const {}

void Viewpoint::nearest(std::span<const Vector> directions, std::span<FaceId> faces, std::span<float> distances,
                        const Progress&) const {
  const FloatingPointMode mode;
  check_size(faces.size(), directions.size());
  check_size(distances.size(), directions.size());
  const WholeView& view = kept_->whole_view();
  for_ranges(kept_->executor, directions.size(), kFewestRays, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) {
      const Camera::Hit hit = view.nearest(directions[i]);
      faces[i] = hit.face;
      distances[i] = hit.depth;
    }
  });
}

AllHits Viewpoint::all_hits(std::span<const Vector> directions, const Progress&) const {
  const FloatingPointMode mode;
  const WholeView& view = kept_->whole_view();
  AllHits hits;
  std::vector<WholeView::Meeting> meetings;
  for (const Vector& direction : directions) {
    view.meet_all(direction, meetings);
    for (const auto& meeting : meetings) {
      hits.faces.push_back(meeting.face);
      hits.distances.push_back(meeting.distance);
    }
    hits.begins.push_back(hits.faces.size());
  }
  return hits;
}

std::size_t Viewpoint::memory_bytes() const { return sizeof(Kept) + (kept_->view ? kept_->view->memory_bytes() : 0); }

}  // namespace facemap
