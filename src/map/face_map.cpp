#include <facemap/face_map.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/cover.h"
#include "map/face_planes.h"
#include "map/fill.h"
#include "map/map_faces.h"
#include "map/ray_tests.h"
#include "map/texels.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

std::size_t texel_count(const Projection& projection) {
  return static_cast<std::size_t>(projection.width()) * static_cast<std::size_t>(projection.height());
}

Texels build_texels(const Scene& scene, const SpaceVector& frame, const Projection& projection,
                    const FacePlanesTable& planes, Builder builder, bool keep_all) {
  if (builder == Builder::Fill) {
    std::vector<TexelEntry> entries;
    fill_faces(scene, frame, projection, entries);
    for (TexelEntry& entry : entries) entry.nearest = planes.nearest(entry.face);
    return Texels(texel_count(projection), entries, {});
  }
  const Coverage coverage = cover_faces(scene, frame, projection, planes, keep_all);
  return Texels(texel_count(projection), coverage.entries, coverage.cuts);
}

}  // namespace

FaceMap::FaceMap(const MapFaces& faces, const SpaceVector& frame, const Projection& projection, Builder builder,
                 bool keep_all, std::shared_ptr<const FacePlanesTable> planes)
    : SpaceVector(frame),
      scene_(&faces.scene),
      all_(&faces.all()),
      solid_(&faces.solid()),
      cut_outs_(faces.cut_outs),
      projection_(projection),
      builder_(builder),
      planes_(std::move(planes)) {
  const FloatingPointMode mode;
  if (planes_ == nullptr) planes_ = std::make_shared<const FacePlanesTable>(*all_, position());
  const auto build = [&](const Scene& scene, bool keeps_all) {
    return std::make_unique<Texels>(build_texels(scene, *this, projection, *planes_, builder, keeps_all));
  };
  texels_ = faces.is_cut_alone ? std::make_unique<Texels>(texel_count(projection), std::span<const TexelEntry>(),
                                                          std::span<const float>())
                               : build(*solid_, keep_all);
  // Nothing is hidden for certain behind a face with holes.
  if (faces.has_cut_outs()) cut_texels_ = build(cut_outs_->cut(), true);
}

FaceMap::~FaceMap() = default;
FaceMap::FaceMap(FaceMap&&) noexcept = default;
FaceMap& FaceMap::operator=(FaceMap&&) noexcept = default;

int FaceMap::side(FaceId face) const { return planes_->side(static_cast<std::uint32_t>(face)); }

std::span<const std::uint32_t> FaceMap::faces_at(int texel_x, int texel_y) const {
  return texels_->faces_at(static_cast<std::size_t>(texel_y) * static_cast<std::size_t>(width()) +
                           static_cast<std::size_t>(texel_x));
}

std::span<const std::uint32_t> FaceMap::cut_outs_at(int texel_x, int texel_y) const {
  if (!has_cut_outs()) return {};
  return cut_texels_->faces_at(static_cast<std::size_t>(texel_y) * static_cast<std::size_t>(width()) +
                               static_cast<std::size_t>(texel_x));
}

std::optional<FaceMap::Texel> FaceMap::texel_of(const DVector& direction) const {
  const FloatingPointMode mode;
  if (!std::isfinite(direction.x) || !std::isfinite(direction.y) || !std::isfinite(direction.z)) return std::nullopt;
  const DVector local = local_from_world(direction);
  if (!projection_.is_mapped(local)) return std::nullopt;
  const MapPoint p = projection_.map_from_local(local);
  if (!(p.x >= 0 && p.x < width() && p.y >= 0 && p.y < height())) return std::nullopt;
  return Texel{static_cast<int>(p.x), static_cast<int>(p.y)};
}

int FaceMap::count_hits(const Vector& direction, Counters* counters) const {
  const FloatingPointMode mode;
  const std::optional<Texel> texel = texel_of(DVector(direction));
  if (!texel) return 0;
  const RayTests tests{*scene_, *planes_, position(), direction, counters};
  const auto never = [](std::uint32_t) { return false; };
  int hits = 0;
  tests.for_each_met(faces_at(texel->x, texel->y), never, [&](std::uint32_t, const Covering&) { ++hits; });
  tests.for_each_met(cut_outs_at(texel->x, texel->y), never, [&](std::uint32_t id, const Covering&) {
    hits += cut_outs_->is_there(id, DVector(position()), DVector(direction));
  });
  return hits;
}

std::size_t FaceMap::memory_bytes() const noexcept { return planes_->memory_bytes() + list_bytes(); }

std::size_t FaceMap::list_bytes() const noexcept {
  return texels_->memory_bytes() + (has_cut_outs() ? cut_texels_->memory_bytes() : 0);
}

std::size_t FaceMap::entry_count() const noexcept {
  return texels_->entry_count() + (has_cut_outs() ? cut_texels_->entry_count() : 0);
}

}  // namespace facemap
