#include <facemap/error.h>
#include <facemap/parallel_light.h>

#include <cmath>

#include "map/face_planes.h"
#include "map/parallel_parts.h"
#include "math/dvector.h"
#include "math/parallel_signs.h"
#include "scene/cut_outs.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr std::uint32_t kSkipNone = 0xffffffffu;

bool is_finite(const Vector& v) { return std::isfinite(double{v.x} + v.y + v.z); }

ParallelFrame::Place place_in(const ParallelFrame& frame, const TruePoint& p) {
  return frame.place(offset_from(frame.origin(), p, ray_parameter(p)), ParallelFrame::kPlaceError);
}

ParallelFrame::Place place_in(const ParallelFrame& frame, const GivenPoint& p) {
  return frame.place(offset_from(frame.origin(), p),
                     p.on_face != nullptr ? ParallelFrame::kPlaceError : ParallelFrame::kSharpError);
}

bool has_tolerance(const TruePoint&) { return false; }
bool has_tolerance(const GivenPoint& p) { return p.tolerance > 0; }

}  // namespace

// Front to back. With a tolerance a face that the filter takes for a blocker, or one that is known by the cut alone,
// may be within it: then no answer is taken from either.
template <class Point>
bool ParallelLight::is_blocked_by(bool by_cut_outs, const Point& point, const DVector& place_of_point,
                                  std::uint32_t skip, Counters* counters) const {
  const Parts& of_faces = by_cut_outs ? cut_parts() : parts();
  const Scene& all = by_cut_outs ? cut_outs().cut() : solid_faces();
  const ParallelFrame& frame = of_faces.frame;
  const ParallelFaces& faces = of_faces.faces;
  const ParallelFrame::Place place = place_in(frame, point);
  Parts::Candidates candidates = of_faces.candidates(all, place);
  const double depth = frame.depth(place.at.z);
  const bool is_past_cut = depth > candidates.cut * (1.0 + Texels::kDepthMargin);
  if (is_past_cut && !has_tolerance(point)) {
    if (counters != nullptr) ++counters->by_float;
    return true;
  }
  const auto is_there = [&](std::uint32_t id) {
    return !by_cut_outs || cut_outs().is_there(id, place_of_point, DVector(direction()));
  };
  const double reach = frame.depth(place.at.z + place.error) * (1 + Texels::kDepthMargin);
  const auto asked = of_faces.asked(candidates, place);
  if (is_past_cut) candidates = {all.kept_faces(), candidates.cut, false};
  for (const std::uint32_t id : candidates.ids) {
    if (candidates.is_list && faces.nearest(id) > reach) return false;
    if (id == skip) continue;
    if (asked) {
      const ParallelFaces::Sides sides = faces.sides(id, *asked);
      const bool is_clear = sides.surely_outside || sides.beyond < 0;
      const bool is_sure = is_clear || (sides.surely_inside && sides.beyond > 0 && !has_tolerance(point));
      if (is_sure && counters != nullptr) ++counters->by_float;
      if (is_clear) continue;
      if (is_sure && is_there(id)) return true;
      if (is_sure) continue;
    }
    if (blocks_along(triangle_of(scene(), id), faces.side(id), direction(), point, counters) && is_there(id)) {
      return true;
    }
  }
  return false;
}

template <class Point>
bool ParallelLight::is_blocked(const Point& point, const DVector& place, std::uint32_t skip, Counters* counters) const {
  return is_blocked_by(false, point, place, skip, counters) ||
         (has_cut_outs() && is_blocked_by(true, point, place, skip, counters));
}

bool ParallelLight::is_blocked(const SurfacePoint& point, Counters* counters) const {
  const FloatingPointMode mode;
  const TruePoint p{point.origin, point.direction, point.vertices, point.side};
  const std::uint32_t skip = point.face == kNoFace ? kSkipNone : static_cast<std::uint32_t>(point.face);
  return is_blocked(p, seen_point(point), skip, counters);
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
  if (on.face == kNoFace) return !is_blocked(given, DVector(point), kSkipNone, counters);
  if (on.face < 0 || static_cast<std::size_t>(on.face) >= scene().face_count() ||
      !all_faces().is_kept(static_cast<std::size_t>(on.face))) {
    throw Error("the face that a point lies on is not one of the scene's kept faces");
  }
  const auto skip = static_cast<std::uint32_t>(on.face);
  const Triangle own = triangle_of(scene(), skip);
  given.on_face = &own;
  return !is_blocked(given, DVector(point), skip, counters);
}

void ParallelLight::get_lighten_up(std::span<const Vector> points, std::span<std::uint8_t> lit,
                                   Counters* counters) const {
  if (lit.size() != points.size()) throw Error("as many answers as points are needed");
  for (std::size_t i = 0; i < points.size(); ++i) lit[i] = get_lighten_up(points[i], counters);
}

}  // namespace facemap
