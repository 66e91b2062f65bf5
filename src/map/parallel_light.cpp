#include <facemap/error.h>
#include <facemap/parallel_light.h>

#include <algorithm>
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

// Of a cube's side: sqrt(3), rounded up.
constexpr double kLongestDiagonal = 1.7320509;

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

// Whether the point need not lie on the face that is passed over.
bool may_be_anywhere(const TruePoint&) { return false; }
bool may_be_anywhere(const GivenPoint& p) { return p.on_face == nullptr; }

}  // namespace

/// A place, and which faces do not count there.
struct ParallelLight::Asked {
  ParallelFrame::Place place;
  std::uint32_t skip = kSkipNone;
  bool has_tolerance = false;
  bool may_be_behind_skip = false;  ///< by any distance
};

// The one walk through a list, front to back, by all who ask. blocks_exactly(face) is called where the filter leaves a
// face open; is_there(face) says of one that blocks whether it has no hole at the crossing. With a tolerance a face
// that the filter takes for a blocker, or one that is known by the cut alone, may be within it: then no answer is taken
// from either. Nor is one from the cut where the face that is passed over may be what cuts.
template <class IsThere, class BlocksExactly>
bool ParallelLight::walk(const Parts& of_faces, const Scene& all, const Asked& asked, Counters* counters,
                         const IsThere& is_there, const BlocksExactly& blocks_exactly) const {
  const ParallelFrame& frame = of_faces.frame;
  const ParallelFaces& faces = of_faces.faces;
  const ParallelFrame::Place& place = asked.place;
  const Parts::Candidates candidates = of_faces.candidates(all, place);
  const bool is_past_cut = frame.depth(place.at.z) > candidates.cut * (1.0 + Texels::kDepthMargin);
  if (is_past_cut && !asked.has_tolerance && !asked.may_be_behind_skip) {
    if (counters != nullptr) ++counters->by_float;
    return true;
  }
  const double reach = frame.depth(place.at.z + place.error) * (1 + Texels::kDepthMargin);
  const auto filtered = of_faces.asked(candidates, place);
  const auto stands_between = [&](std::uint32_t id) {
    if (id == asked.skip) return false;
    if (filtered) {
      const ParallelFaces::Sides sides = faces.sides(id, *filtered);
      const bool is_clear = sides.surely_outside || sides.beyond < 0;
      const bool is_sure = is_clear || (sides.surely_inside && sides.beyond > 0 && !asked.has_tolerance);
      if (is_sure && counters != nullptr) ++counters->by_float;
      if (is_sure) return !is_clear && is_there(id);
    }
    return blocks_exactly(id, faces.side(id)) && is_there(id);
  };
  for (const std::uint32_t id : candidates.ids) {
    if (candidates.is_list && faces.nearest(id) > reach) break;
    if (stands_between(id)) return true;
  }
  const std::span<const std::uint32_t> kept = all.kept_faces();
  return is_past_cut && std::any_of(kept.begin(), kept.end(), stands_between);
}

template <class Point>
bool ParallelLight::is_blocked(const Point& point, const DVector& place, std::uint32_t skip, Counters* counters) const {
  const auto blocks_exactly = [&](std::uint32_t id, int side) {
    return blocks_along(triangle_of(scene(), id), side, direction(), point, counters);
  };
  const bool may_be_behind_skip = skip != kSkipNone && may_be_anywhere(point);
  const Asked asked{place_in(parts().frame, point), skip, has_tolerance(point), may_be_behind_skip};
  const auto always = [](std::uint32_t) { return true; };
  if (walk(parts(), solid_faces(), asked, counters, always, blocks_exactly)) return true;
  if (!has_cut_outs()) return false;
  const Asked asked_of_cut{place_in(cut_parts().frame, point), skip, has_tolerance(point), may_be_behind_skip};
  const auto is_there = [&](std::uint32_t id) { return cut_outs().is_there(id, place, DVector(direction())); };
  return walk(cut_parts(), cut_outs().cut(), asked_of_cut, counters, is_there, blocks_exactly);
}

bool ParallelLight::is_blocked(const Vector& point, FaceId skip, float tolerance, Counters* counters) const {
  const FloatingPointMode mode;
  if (!is_finite(point)) throw Error("a point to be lit is not finite");
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) throw Error("a tolerance is 0 or more, and finite");
  GivenPoint given{point};
  given.tolerance = tolerance;
  return is_blocked(given, DVector(point), skip == kNoFace ? kSkipNone : static_cast<std::uint32_t>(skip), counters);
}

std::optional<bool> ParallelLight::is_blocked_around(const DVector& point, double error, FaceId skip,
                                                     Counters* counters) const {
  const auto asked_in = [&](const ParallelFrame& frame) {
    Asked asked{frame.place(point - DVector(frame.origin()), ParallelFrame::kSharpError)};
    asked.place.error += kLongestDiagonal * error;
    if (skip != kNoFace) asked.skip = static_cast<std::uint32_t>(skip);
    return asked;
  };
  const auto is_too_far = [](const ParallelFrame& frame, const Asked& asked) {
    return frame.find(asked.place).where == ParallelFrame::Where::Anywhere;
  };
  bool is_open = false;
  const auto leave_open = [&](std::uint32_t, int) {
    is_open = true;
    return false;
  };
  const Asked asked = asked_in(parts().frame);
  if (is_too_far(parts().frame, asked)) return std::nullopt;
  const auto always = [](std::uint32_t) { return true; };
  if (walk(parts(), solid_faces(), asked, counters, always, leave_open)) return true;
  if (has_cut_outs() && !is_open) {
    const Asked asked_of_cut = asked_in(cut_parts().frame);
    if (is_too_far(cut_parts().frame, asked_of_cut)) return std::nullopt;
    const auto is_there = [&](std::uint32_t id) { return leave_open(id, 0); };
    walk(cut_parts(), cut_outs().cut(), asked_of_cut, counters, is_there, leave_open);
  }
  if (is_open) return std::nullopt;
  return false;
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
