#include <facemap/error.h>
#include <facemap/viewpoint.h>

#include <cmath>

#include "map/face_planes.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

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
      faces(map_faces(scene, options.cut_outs, options.max_texture_pixels)),
      visible_points(faces, origin, executor) {}

const RayLists& Viewpoint::Kept::near_lists() {
  return near.get([&] { return make_lists(false); });
}

const RayLists& Viewpoint::Kept::whole_lists() {
  return whole.get([&] { return make_lists(true); });
}

std::unique_ptr<RayLists> Viewpoint::Kept::make_lists(bool keep_all) {
  using Planes = std::shared_ptr<const FacePlanesTable>;
  const Planes& table = planes.get(
      [&] { return std::make_unique<Planes>(std::make_shared<const FacePlanesTable>(faces.all(), origin)); });
  return std::make_unique<RayLists>(faces, origin, table, keep_all, executor);
}

const VisibleFaceSearch& Viewpoint::Kept::face_search() {
  return seen_faces.get([&] { return std::make_unique<VisibleFaceSearch>(faces, origin, executor); });
}

Viewpoint::Viewpoint(const Scene& scene, const Vector& origin, const Options& options)
    : kept_(std::make_unique<Kept>(scene, origin, options)) {}
Viewpoint::~Viewpoint() = default;
Viewpoint::Viewpoint(Viewpoint&&) noexcept = default;
Viewpoint& Viewpoint::operator=(Viewpoint&&) noexcept = default;

const Scene& Viewpoint::scene() const noexcept { return kept_->scene; }
const Vector& Viewpoint::origin() const noexcept { return kept_->origin; }

std::size_t Viewpoint::memory_bytes() const {
  std::size_t bytes = sizeof(Kept) + kept_->visible_points.memory_bytes();
  if (const auto* planes = kept_->planes.if_made()) bytes += (*planes)->memory_bytes();
  if (const RayLists* near = kept_->near.if_made()) bytes += near->memory_bytes();
  if (const RayLists* whole = kept_->whole.if_made()) bytes += whole->memory_bytes();
  if (const VisibleFaceSearch* search = kept_->seen_faces.if_made()) bytes += search->memory_bytes();
  return bytes;
}

}  // namespace facemap
