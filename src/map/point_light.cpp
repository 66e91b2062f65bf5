#include <facemap/error.h>
#include <facemap/point_light.h>

#include <algorithm>
#include <cmath>

#include "map/cover.h"
#include "map/face_planes.h"
#include "map/texels.h"
#include "math/dvector.h"
#include "math/elementary.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr double kAllAround = 2 * elementary::kPi;

// A fitted field wider than this (radians, half) is given up for all directions: towards 180 degrees a disc has
// no centre worth aiming at.
constexpr double kWidestFit = 1.4;

// Half a fitted field is at least this (radians), so that a texel stays far above the errors of directions.
constexpr double kNarrowestFit = 0x1p-24;

// Share by which a fitted field is wider than its faces: a rim for the projection's error.
constexpr double kFieldMargin = 1e-3;

constexpr int kFewestTexels = 64;  // a side
constexpr int kMostTexels = 2048;  // a side

DVector sight_of(const Scene& scene, const Vector& position) {
  const FloatingPointMode mode;
  const DVector towards = scene.centre() - DVector(position);
  return length(towards) > 0 ? towards : DVector(0, 0, -1);
}

// The largest angle between the sight and a vertex of a kept face (radians). A vertex at the light itself belongs
// to faces that it sees edge-on and that nothing hits.
double half_field_of_faces(const Scene& scene, const SpaceVector& frame) {
  double half = 0;
  for (const std::uint32_t id : scene.kept_faces()) {
    for (const Vector& v : triangle_of(scene, id)) {
      half = std::max(half, angle_between(frame.axis_z(), DVector(v) - DVector(frame.position())));
    }
  }
  return half;
}

int texels_for(std::size_t faces) {
  int texels = kFewestTexels;
  while (texels < kMostTexels && static_cast<double>(texels) * texels < static_cast<double>(faces)) texels *= 2;
  return texels;
}

Projection projection_for(const Scene& scene, const SpaceVector& frame, const PointLight::Options& options) {
  const FloatingPointMode mode;
  if (options.texels < 0) throw Error("texels of a light's map must not be negative");
  const int texels = options.texels > 0 ? options.texels : texels_for(scene.kept_faces().size());
  // Within 90 degrees of the sight a face lies in the convex hull of its corners' directions.
  const double half = half_field_of_faces(scene, frame);
  const double fitted = std::max(half, kNarrowestFit) * (1 + kFieldMargin);
  double field_angle = options.field_angle;
  if (field_angle == 0) {
    field_angle = fitted > kWidestFit ? kAllAround : 2 * fitted;
  } else if (!options.keep_all && field_angle < kAllAround &&
             !(half < elementary::kPi / 2 && field_angle >= 2 * fitted)) {
    throw Error("the field angle of a light's map does not hold every face of the scene");
  }
  return Projection(ProjectionKind::Surface, field_angle, texels, texels);
}

constexpr std::uint32_t kSkipNone = 0xffffffffu;

}  // namespace

PointLight::PointLight(const Scene& scene, const Vector& position, const Options& options)
    : PointLight(scene, SpaceVector::looking_along(position, sight_of(scene, position)), options) {}

PointLight::PointLight(const Scene& scene, const SpaceVector& frame, const Options& options)
    : FaceMap(scene, frame, projection_for(scene, frame, options), options.builder, options.keep_all) {}

template <class Point>
bool PointLight::is_blocked(const DVector& offset, const Point& point, std::uint32_t skip, bool exact_only,
                            Counters* counters) const {
  const std::optional<Texel> texel = texel_of(offset);
  if (!texel) return false;
  const std::size_t texel_index =
      static_cast<std::size_t>(texel->y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(texel->x);
  const std::span<const std::uint32_t> ids = texels().faces_at(texel_index);

  const double scale = planes().scale();
  const float D[3] = {static_cast<float>(offset.x * scale), static_cast<float>(offset.y * scale),
                      static_cast<float>(offset.z * scale)};
  const double true_length = length(offset) * scale;
  const bool is_past_cut = true_length > texels().cut(texel_index) * (1.0 + Texels::kDepthMargin);
  const auto exact = [&](std::uint32_t id) {
    return blocks(triangle_of(scene(), id), planes().side(id), position(), point, counters);
  };

  if (exact_only || !(true_length < simd::kLargestLength)) {
    // Beyond a full cover the list is not complete: ask every face.
    const auto all = is_past_cut ? std::span<const std::uint32_t>(scene().kept_faces()) : ids;
    return std::any_of(all.begin(), all.end(), [&](std::uint32_t id) { return id != skip && exact(id); });
  }
  if (is_past_cut) {
    if (counters != nullptr) ++counters->by_float;
    return true;
  }

  const auto bound = static_cast<float>(true_length * (1 + 0x1p-20));
  const auto reach = static_cast<float>(true_length * (1.0 + Texels::kDepthMargin));
  std::uint32_t few[kFewUndecided];
  std::vector<std::uint32_t> many(ids.size() > kFewUndecided ? ids.size() : 0);
  std::uint32_t* undecided = many.empty() ? few : many.data();
  const simd::BlockWalk walk = simd::find_blocker(planes().planes(), planes().nearest(), ids.data(), ids.size(), D,
                                                  bound, reach, skip, undecided);
  if (counters != nullptr) counters->by_float += walk.tested - walk.undecided;
  if (walk.blocked) return true;
  return std::any_of(undecided, undecided + walk.undecided, exact);
}

bool PointLight::is_blocked(const SurfacePoint& point, Counters* counters) const {
  const FloatingPointMode mode;
  const TruePoint p{point.origin, point.direction, point.vertices, point.side};
  const DVector offset = offset_from(position(), p, ray_parameter(p));
  if (offset == DVector(0)) return false;
  const std::uint32_t skip = point.face == kNoFace ? kSkipNone : static_cast<std::uint32_t>(point.face);
  return is_blocked(offset, p, skip, false, counters);
}

bool PointLight::get_lighten_up(const SurfacePoint& point, Counters* counters) const {
  const FloatingPointMode mode;
  if (point.face != kNoFace && (point.face < 0 || static_cast<std::size_t>(point.face) >= scene().face_count())) {
    throw Error("the face of a surface point is not one of the scene");
  }
  const int own_side = point.face == kNoFace ? facemap::side(point.vertices, position()) : side(point.face);
  return own_side * point.side > 0 && !is_blocked(point, counters);
}

bool PointLight::get_lighten_up(const Vector& point, const On& on, Counters* counters) const {
  const FloatingPointMode mode;
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
    throw Error("a point to be lit is not finite");
  }
  if (!(on.tolerance >= 0) || !std::isfinite(on.tolerance) || (on.tolerance > 0 && on.face != kNoFace)) {
    throw Error("a point to be lit takes a face or a finite tolerance that is not negative, not both");
  }
  GivenPoint given{point};
  given.tolerance = on.tolerance;
  Triangle own;
  std::uint32_t skip = kSkipNone;
  if (on.face != kNoFace) {
    if (on.face < 0 || static_cast<std::size_t>(on.face) >= scene().face_count() ||
        !scene().is_kept(static_cast<std::size_t>(on.face))) {
      throw Error("the face that a point lies on is not one of the scene's kept faces");
    }
    skip = static_cast<std::uint32_t>(on.face);
    own = triangle_of(scene(), skip);
    given.on_face = &own;
  }
  const DVector offset = offset_from(position(), given);
  if (offset == DVector(0)) return true;
  return !is_blocked(offset, given, skip, on.tolerance > 0, counters);
}

}  // namespace facemap
