#include "visibility/ray_map.h"

#include <algorithm>
#include <span>
#include <utility>

#include "map/face_planes.h"
#include "map/list_point.h"
#include "map/map_faces.h"
#include "map/nearest_hit.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "simd/list_points.h"
#include "visibility/first_blocker.h"

namespace facemap {
namespace {

// Entries given to the filter at a time: a list is front to back, and the first blocker mostly among the first few.
constexpr std::size_t kChunk = 16;

}  // namespace

RayMap::RayMap(const MapFaces& faces, const SpaceVector& frame, const Projection& projection,
               std::shared_ptr<const FacePlanesTable> planes, bool keep_all)
    : Camera(faces, frame, projection, std::move(planes), keep_all) {}

Camera::Hit RayMap::nearest_in(const Texel& texel, const Vector& direction) const {
  NearestHit best(scene(), position(), direction, nullptr);
  meet_faces(texel, direction, best, nullptr);
  return best.with_depth();
}

std::optional<FaceId> RayMap::first_blocker(const Texel& texel, const Vector& point, std::uint32_t skip) const {
  const GivenPoint given{point};
  const DVector offset = offset_from(position(), given);
  const double length_in_map = length(offset) * planes().scale();
  const bool is_for_filter = length_in_map < simd::kLargestOffset;
  const simd::ListPoint asked =
      is_for_filter ? list_point(offset * planes().scale(), length_in_map) : simd::ListPoint();

  FirstBlocker first(scene(), position(), point);
  const auto reach = [&] { return std::min(length_in_map, first.reach() * planes().scale()); };
  const auto meet_listed = [&](std::span<const std::uint32_t> ids, const auto& is_there) {
    simd::Verdict verdicts[kChunk];
    std::fill_n(verdicts, kChunk, simd::kUndecided);
    for (std::size_t begin = 0; begin < ids.size(); begin += kChunk) {
      const std::span<const std::uint32_t> chunk = ids.subspan(begin, std::min(kChunk, ids.size() - begin));
      if (planes().nearest(chunk[0]) > reach() * (1.0 + Texels::kDepthMargin)) break;
      if (is_for_filter) simd::block_verdicts(planes().planes(), chunk.data(), chunk.size(), asked, verdicts);
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        const std::uint32_t id = chunk[i];
        if (verdicts[i] == simd::kNo || id == skip) continue;
        const int side = planes().side(id);
        const bool is_between = verdicts[i] == simd::kYes || blocks(triangle_of(scene(), id), side, position(), given);
        if (is_between && is_there(id)) first.meet(id, side);
      }
    }
  };
  meet_listed(faces_at(texel.x, texel.y), [](std::uint32_t) { return true; });
  const std::size_t index =
      static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(texel.x);
  // Faces that are missing begin beyond the cut; one that is not skipped fills the texel before them.
  if (skip != kSkipNone && is_beyond(reach(), texels().cut(index))) return std::nullopt;
  meet_listed(cut_outs_at(texel.x, texel.y), [&](std::uint32_t id) {
    return cut_outs().is_there(id, DVector(point), DVector(position()) - DVector(point));
  });
  return first.face();
}

}  // namespace facemap
