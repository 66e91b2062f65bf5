#include <facemap/error.h>
#include <facemap/parallel_map.h>

#include <cmath>
#include <limits>
#include <optional>

#include "map/face_planes.h"
#include "map/map_faces.h"
#include "map/nearest_hit.h"
#include "map/parallel_cover.h"
#include "map/parallel_parts.h"
#include "map/raster_size.h"
#include "math/dvector.h"
#include "math/parallel_signs.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr int kMostTexels = 16384;  // a side

int texels_of(const Scene& scene, const ParallelMap::Options& options) {
  if (options.texels < 0 || options.texels > kMostTexels) throw Error("texels of a parallel map must be 0 to 16384");
  return options.texels > 0 ? options.texels : texels_for(scene.kept_faces().size());
}

Texels build_texels(const Scene& scene, const ParallelFrame& frame, const ParallelFaces& faces, bool keep_all) {
  const auto count = static_cast<std::size_t>(frame.width()) * static_cast<std::size_t>(frame.height());
  const Coverage coverage = cover_faces_along(scene, frame, faces, keep_all);
  return Texels(count, coverage.entries, coverage.cuts);
}

}  // namespace

ParallelMap::Parts::Parts(const Scene& scene, const Vector& direction, const Options& options)
    : frame(scene, direction, texels_of(scene, options)),
      faces(scene, direction, frame),
      texels(build_texels(scene, frame, faces, options.keep_all)) {}

ParallelMap::Parts::Candidates ParallelMap::Parts::candidates(const Scene& scene,
                                                              const ParallelFrame::Place& place) const {
  constexpr float kNoCut = std::numeric_limits<float>::infinity();
  const ParallelFrame::Found found = frame.find(place);
  if (found.where == ParallelFrame::Where::Nowhere) return {{}, kNoCut, true};
  if (found.where == ParallelFrame::Where::Anywhere) return {scene.kept_faces(), kNoCut, false};
  return {texels.faces_at(found.texel), texels.cut(found.texel), true};
}

std::optional<ParallelFaces::Asked> ParallelMap::Parts::asked(const Candidates& candidates,
                                                              const ParallelFrame::Place& place) const {
  if (!candidates.is_list || candidates.ids.empty()) return std::nullopt;
  return faces.asked(place);
}

ParallelMap::ParallelMap(const Scene& scene, const Vector& direction, const Options& options)
    : scene_(&scene), direction_(direction) {
  const FloatingPointMode mode;
  const MapFaces faces = map_faces(scene, options.cut_outs, options.max_texture_pixels);
  cut_outs_ = faces.cut_outs;
  all_ = &faces.all();
  solid_ = &faces.solid();
  parts_ = std::make_unique<Parts>(*solid_, direction, options);
  if (!faces.has_cut_outs()) return;
  Options all = options;
  all.keep_all = true;  // nothing is hidden for certain behind a face with holes
  cut_parts_ = std::make_unique<Parts>(cut_outs_->cut(), direction, all);
}

ParallelMap::~ParallelMap() = default;
ParallelMap::ParallelMap(ParallelMap&&) noexcept = default;
ParallelMap& ParallelMap::operator=(ParallelMap&&) noexcept = default;

int ParallelMap::width() const noexcept { return parts_->frame.width(); }
int ParallelMap::height() const noexcept { return parts_->frame.height(); }

int ParallelMap::side(FaceId face) const {
  const auto id = static_cast<std::uint32_t>(face);
  const int side = parts_->faces.side(id);
  return side != 0 || !has_cut_outs() ? side : cut_parts_->faces.side(id);
}

std::size_t ParallelMap::entry_count() const noexcept {
  return parts_->texels.entry_count() + (has_cut_outs() ? cut_parts_->texels.entry_count() : 0);
}

std::size_t ParallelMap::memory_bytes() const noexcept {
  const auto bytes = [](const Parts& parts) { return parts.faces.memory_bytes() + parts.texels.memory_bytes(); };
  return bytes(*parts_) + (has_cut_outs() ? bytes(*cut_parts_) : 0);
}

std::span<const std::uint32_t> ParallelMap::faces_at(int texel_x, int texel_y) const {
  return parts_->texels.faces_at(static_cast<std::size_t>(texel_y) * static_cast<std::size_t>(width()) +
                                 static_cast<std::size_t>(texel_x));
}

namespace {

/// A ray from `origin` along the map's direction that tells `best` which faces it meets.
class ParallelRay {
 public:
  ParallelRay(const Scene& scene, const Vector& origin, const Vector& direction, const ParallelFaces& faces,
              const std::optional<ParallelFaces::Asked>& asked, const CutOuts* cut_outs, NearestHit& best,
              Counters* counters)
      : scene_(scene),
        O_(origin),
        d_(direction),
        faces_(faces),
        asked_(asked),
        cut_outs_(cut_outs),
        counters_(counters),
        best_(best) {}

  void meet(std::uint32_t id) {
    const int s = faces_.side(id);
    if (asked_) {
      const ParallelFaces::Sides sides = faces_.sides(id, *asked_);
      const bool is_missed = sides.surely_outside || sides.beyond > 0;
      const bool is_hit = sides.surely_inside && sides.beyond < 0;
      if ((is_missed || is_hit) && counters_ != nullptr) ++counters_->by_float;
      if (is_hit && is_there(id)) best_.meet(id, s, true);
      if (is_missed || is_hit) return;
    }
    const Covering covering = covers_along(triangle_of(scene_, id), s, O_, d_, counters_);
    if (covering.hit && is_there(id)) best_.meet(id, s, covering.strictly_inside);
  }

 private:
  bool is_there(std::uint32_t id) const {
    return cut_outs_ == nullptr || cut_outs_->is_there(id, DVector(O_), DVector(d_));
  }

  const Scene& scene_;
  const Vector &O_, &d_;
  const ParallelFaces& faces_;
  const std::optional<ParallelFaces::Asked>& asked_;
  const CutOuts* cut_outs_;  // null: its faces have no holes
  Counters* counters_;
  NearestHit& best_;
};

}  // namespace

Camera::Hit ParallelMap::nearest(const Vector& origin, Counters* counters) const {
  const FloatingPointMode mode;
  if (!std::isfinite(double{origin.x} + origin.y + origin.z)) return {};
  NearestHit best = nearest_solid(origin, counters);
  if (has_cut_outs()) meet_cut_outs(origin, best, counters);
  return best.with_depth();
}

NearestHit ParallelMap::nearest_solid(const Vector& origin, Counters* counters) const {
  const ParallelFrame& frame = parts_->frame;
  const ParallelFaces& faces = parts_->faces;
  const DVector offset = offset_from(frame.origin(), GivenPoint{origin});
  const ParallelFrame::Place place = frame.place(offset, ParallelFrame::kSharpError);
  const Parts::Candidates candidates = parts_->candidates(*solid_, place);
  const auto asked = parts_->asked(candidates, place);
  NearestHit best(scene(), origin, direction_, counters);
  ParallelRay ray(scene(), origin, direction_, faces, asked, nullptr, best, counters);
  const auto depth_of_best = [&] { return frame.depth(place.at.z + place.error + best.reach()); };
  for (const std::uint32_t id : candidates.ids) {
    if (candidates.is_list && faces.nearest(id) > depth_of_best() * (1 + Texels::kDepthMargin)) break;
    ray.meet(id);
  }
  // Faces behind the cut are missing. A ray that starts before the face that covers the texel meets it or a nearer one.
  if (!(depth_of_best() > candidates.cut * (1.0 + Texels::kDepthMargin))) return best;
  NearestHit best_of_all(scene(), origin, direction_, counters);
  ParallelRay through_all(scene(), origin, direction_, faces, asked, nullptr, best_of_all, counters);
  for (const std::uint32_t id : solid_->kept_faces()) through_all.meet(id);
  return best_of_all;
}

void ParallelMap::meet_cut_outs(const Vector& origin, NearestHit& best, Counters* counters) const {
  const ParallelFrame& frame = cut_parts_->frame;
  const ParallelFaces& faces = cut_parts_->faces;
  const DVector offset = offset_from(frame.origin(), GivenPoint{origin});
  const ParallelFrame::Place place = frame.place(offset, ParallelFrame::kSharpError);
  const Parts::Candidates candidates = cut_parts_->candidates(cut_outs_->cut(), place);
  const auto asked = cut_parts_->asked(candidates, place);
  ParallelRay ray(scene(), origin, direction_, faces, asked, cut_outs_.get(), best, counters);
  for (const std::uint32_t id : candidates.ids) {
    const double depth = frame.depth(place.at.z + place.error + best.reach());
    if (candidates.is_list && faces.nearest(id) > depth * (1 + Texels::kDepthMargin)) return;
    ray.meet(id);
  }
}

SurfacePoint ParallelMap::surface_point(const Vector& origin, const Camera::Hit& hit) const {
  return {origin, direction_, triangle_of(scene(), static_cast<std::uint32_t>(hit.face)), hit.face, hit.side};
}

}  // namespace facemap
