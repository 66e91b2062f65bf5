#include "visibility/point_lists.h"

#include <algorithm>
#include <span>

#include "map/face_planes.h"
#include "map/list_point.h"
#include "map/texels.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "picture/asked_points.h"

namespace facemap {
namespace {

// Faces of a list that are asked before the undecided among them are asked exactly.
constexpr std::size_t kFewFaces = 64;

}  // namespace

// Of faces without holes. A list is cut behind a face that hides all that is farther, for points that this face may
// hide: others then ask every face besides.
template <class Predicate>
bool PointLists::any_of_list(const Texel& texel, const DVector& offset, std::uint32_t own, float tolerance,
                             const Predicate& blocks) const {
  const std::size_t at =
      static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(texel.x);
  const std::span<const std::uint32_t> ids = texels().faces_at(at);
  const double size = length(offset) * planes().scale();
  const bool is_past_cut = is_beyond(size, texels().cut(at));
  if (is_past_cut && own == kNoOwnFace && tolerance == 0) return true;
  const auto blocks_other = [&](std::uint32_t id) { return id != own && blocks(id); };
  if (is_past_cut || tolerance > 0 || !(size < simd::kLargestOffset)) {
    const std::vector<std::uint32_t>& all = solid_faces().kept_faces();
    return std::any_of(ids.begin(), ids.end(), blocks_other) ||
           (is_past_cut && std::any_of(all.begin(), all.end(), blocks_other));
  }
  const simd::ListPoint asked = list_point(offset * planes().scale(), size);
  std::uint32_t undecided[kFewFaces];
  for (std::size_t first = 0; first < ids.size(); first += kFewFaces) {
    const simd::BlockWalk walk = simd::find_blocker(planes().planes(), ids.data() + first,
                                                    std::min(kFewFaces, ids.size() - first), asked, own, undecided);
    if (walk.blocked || std::any_of(undecided, undecided + walk.undecided, blocks)) return true;
    if (walk.ended) return false;
  }
  return false;
}

template <class Predicate>
bool PointLists::any_of_cut_outs(const Texel& texel, const Vector& point, std::uint32_t own,
                                 const Predicate& blocks) const {
  const DVector place(point), towards = DVector(position()) - place;
  const std::span<const std::uint32_t> ids = cut_outs_at(texel.x, texel.y);
  return std::any_of(ids.begin(), ids.end(), [&](std::uint32_t id) {
    return id != own && blocks(id) && cut_outs().is_there(id, place, towards);
  });
}

bool PointLists::hides(const Vector& point, FaceId own_face, float tolerance) const {
  const DVector offset = DVector(point) - DVector(position());
  if (offset == DVector(0)) return false;
  const std::optional<Texel> texel = texel_of(offset);
  if (!texel) return false;
  const std::uint32_t own = own_face == kNoFace ? kNoOwnFace : static_cast<std::uint32_t>(own_face);
  const GivenPoint given{point, nullptr, tolerance};
  const auto is_between = [&](std::uint32_t id) {
    return blocks(triangle_of(scene(), id), planes().side(id), position(), given);
  };
  return any_of_list(*texel, offset, own, tolerance, is_between) ||
         (has_cut_outs() && any_of_cut_outs(*texel, point, own, is_between));
}

}  // namespace facemap
