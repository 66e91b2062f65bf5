#include <facemap/error.h>
#include <facemap/parallel_light.h>

#include <cmath>

#include "map/face_planes.h"
#include "map/parallel_parts.h"
#include "math/dvector.h"
#include "math/parallel_signs.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr std::uint32_t kSkipNone = 0xffffffffu;

bool is_finite(const Vector& v) { return std::isfinite(double{v.x} + v.y + v.z); }

}  // namespace

// Front to back. With a tolerance a face that the filter takes for a blocker, or one that is known by the cut alone,
// may be within it: then no answer is taken from either.
template <class Point>
bool ParallelLight::is_blocked(const DVector& offset, double relative_error, const Point& point, std::uint32_t skip,
                               float tolerance, Counters* counters) const {
  const ParallelFrame& frame = parts().frame;
  const ParallelFaces& faces = parts().faces;
  const ParallelFrame::Place place = frame.place(offset, relative_error);
  Parts::Candidates candidates = parts().candidates(scene(), place);
  const double depth = frame.depth(place.at.z);
  const bool is_past_cut = depth > candidates.cut * (1.0 + Texels::kDepthMargin);
  if (is_past_cut && !(tolerance > 0)) {
    if (counters != nullptr) ++counters->by_float;
    return true;
  }
  const double reach = frame.depth(place.at.z + place.error) * (1 + Texels::kDepthMargin);
  const auto asked = parts().asked(candidates, place);
  if (is_past_cut) candidates = {scene().kept_faces(), candidates.cut, false};
  for (const std::uint32_t id : candidates.ids) {
    if (candidates.is_list && faces.nearest(id) > reach) return false;
    if (id == skip) continue;
    if (asked) {
      const ParallelFaces::Sides sides = faces.sides(id, *asked);
      const bool is_clear = sides.surely_outside || sides.beyond < 0;
      const bool is_sure = is_clear || (sides.surely_inside && sides.beyond > 0 && !(tolerance > 0));
      if (is_sure && counters != nullptr) ++counters->by_float;
      if (is_clear) continue;
      if (is_sure) return true;
    }
    if (blocks_along(triangle_of(scene(), id), faces.side(id), direction(), point, counters)) return true;
  }
  return false;
}

bool ParallelLight::is_blocked(const SurfacePoint& point, Counters* counters) const {
  const FloatingPointMode mode;
  const TruePoint p{point.origin, point.direction, point.vertices, point.side};
  const DVector offset = offset_from(parts().frame.origin(), p, ray_parameter(p));
  const std::uint32_t skip = point.face == kNoFace ? kSkipNone : static_cast<std::uint32_t>(point.face);
  return is_blocked(offset, ParallelFrame::kPlaceError, p, skip, 0, counters);
}

bool ParallelLight::get_lighten_up(const SurfacePoint& point, Counters* counters) const {
  const FloatingPointMode mode;
  if (point.face != kNoFace && (point.face < 0 || static_cast<std::size_t>(point.face) >= scene().face_count())) {
    throw Error("the face of a surface point is not one of the scene");
  }
  const int own_side = point.face == kNoFace ? side_along(point.vertices, direction()) : side(point.face);
  return own_side * point.side > 0 && !is_blocked(point, counters);
}

bool ParallelLight::get_lighten_up(const Vector& point, const On& on, Counters* counters) const {
  const FloatingPointMode mode;
  if (!is_finite(point)) throw Error("a point to be lit is not finite");
  if (!(on.tolerance >= 0) || !std::isfinite(on.tolerance) || (on.tolerance > 0 && on.face != kNoFace)) {
    throw Error("a point to be lit takes a face or a finite tolerance that is not negative, not both");
  }
  GivenPoint given{point};
  given.tolerance = on.tolerance;
  if (on.face == kNoFace) {
    const DVector offset = offset_from(parts().frame.origin(), given);
    return !is_blocked(offset, ParallelFrame::kSharpError, given, kSkipNone, on.tolerance, counters);
  }
  if (on.face < 0 || static_cast<std::size_t>(on.face) >= scene().face_count() ||
      !scene().is_kept(static_cast<std::size_t>(on.face))) {
    throw Error("the face that a point lies on is not one of the scene's kept faces");
  }
  const auto skip = static_cast<std::uint32_t>(on.face);
  const Triangle own = triangle_of(scene(), skip);
  given.on_face = &own;
  const DVector offset = offset_from(parts().frame.origin(), given);
  return !is_blocked(offset, ParallelFrame::kPlaceError, given, skip, 0, counters);
}

void ParallelLight::get_lighten_up(std::span<const Vector> points, std::span<std::uint8_t> lit,
                                   Counters* counters) const {
  if (lit.size() != points.size()) throw Error("as many answers as points are needed");
  for (std::size_t i = 0; i < points.size(); ++i) lit[i] = get_lighten_up(points[i], counters);
}

}  // namespace facemap
