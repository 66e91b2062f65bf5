#include "map/light_projection.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "map/raster_size.h"
#include "math/dvector.h"
#include "math/elementary.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr double kAllAround = 2 * elementary::kPi;

// A fitted field wider than this (radians, half) is given up for all directions: towards 180 degrees a disc has
// no centre worth aiming at.
constexpr double kWidestFit = 1.4;

// The same for a plane, as a tangent (63 degrees): beyond, its middle would be too coarse.
constexpr double kWidestPlane = 2;

// Half a fitted field is at least this (radians), so that a texel stays far above the errors of directions.
constexpr double kNarrowestFit = 0x1p-24;

// Share by which a fitted field is wider than its faces: a rim for the projection's error.
constexpr double kFieldMargin = 1e-3;

// How far the faces reach from the sight, as tangents of angles: across, up and in any direction. Infinite if a vertex
// of a kept face is not in front. A vertex at the light itself belongs to faces that it sees edge-on and nothing hits.
struct Reach {
  double x = 0, y = 0, r = 0;
};

Reach reach_of_faces(const Scene& scene, const SpaceVector& frame) {
  const DVector O(frame.position());
  Reach reach;
  for (const std::uint32_t id : scene.kept_faces()) {
    for (const Vector& v : triangle_of(scene, id)) {
      const DVector p = frame.local_from_world(DVector(v) - O);
      if (p == DVector(0)) continue;
      if (!(p.z > 0)) return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
      reach.x = std::max(reach.x, std::fabs(p.x) / p.z);
      reach.y = std::max(reach.y, std::fabs(p.y) / p.z);
      reach.r = std::max(reach.r, (p.x * p.x + p.y * p.y) / (p.z * p.z));
    }
  }
  reach.r = std::sqrt(reach.r);
  return reach;
}

// Departs: the paper's maps are surfaces, round the whole of a light. Seen from outside, a scene fits a plane, on which
// edges stay straight and points are found without an angle. Of oblong scenes the raster is oblong too.
Projection plane_for(const Reach& reach, int texels, bool is_square) {
  double x = std::max(reach.x, kNarrowestFit) * (1 + kFieldMargin);
  double y = std::max(reach.y, kNarrowestFit) * (1 + kFieldMargin);
  if (is_square) x = y = std::max(x, y);
  const double stretch = std::sqrt(std::clamp(y / x, 1 / kMostOblong, kMostOblong));
  const int width = static_cast<int>(std::ceil(texels / stretch)),
            height = static_cast<int>(std::ceil(texels * stretch));
  const double half_height = std::max(y, x * height / width);
  return Projection(ProjectionKind::Plane, 2 * elementary::atan2(half_height, 1), width, height);
}

}  // namespace

DVector sight_of_light(const Scene& scene, const Vector& position) {
  const FloatingPointMode mode;
  const DVector towards = scene.centre() - DVector(position);
  return length(towards) > 0 ? towards : DVector(0, 0, -1);
}

Projection light_projection(const Scene& scene, const SpaceVector& frame, const PointLight::Options& options) {
  const FloatingPointMode mode;
  if (options.texels < 0) throw Error("texels of a light's map must not be negative");
  const bool is_given = options.texels > 0;
  const int texels = is_given ? options.texels : texels_for(scene.kept_faces().size());
  const Reach reach = reach_of_faces(scene, frame);
  if (options.field_angle == 0 && reach.r < kWidestPlane) return plane_for(reach, texels, is_given);
  // Within 90 degrees of the sight a face lies in the convex hull of its corners' directions.
  const double half = reach.r < HUGE_VAL ? elementary::atan2(reach.r, 1) : elementary::kPi;
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

}  // namespace facemap
