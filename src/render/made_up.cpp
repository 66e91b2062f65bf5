#include <facemap/affine.h>
#include <facemap/error.h>
#include <facemap/renderer.h>

#include <algorithm>
#include <cmath>

#include "math/dvector.h"
#include "math/elementary.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

// A made-up camera steps no closer to the sphere's surface than this share of its radius: wide fields would
// put it inside.
constexpr double kClosestApproach = 0.05;

// Radians: a lens whose sight passes its picture by shows a scene from so far away, and not where it looks.
constexpr double kLeastHalfField = 0x1p-6;

constexpr int kMadeUpLights = 8;

// cos(2 pi k / 8); the sine is the cosine of two steps back.
constexpr double kHalfRoot = 0.70710678118654752;
constexpr double kCosines[kMadeUpLights] = {1, kHalfRoot, 0, -kHalfRoot, -1, -kHalfRoot, 0, kHalfRoot};

// The least angle between the sight and the middles of the picture's borders, at most 90 degrees.
double half_field(const Lens& lens) {
  const double w = lens.width(), h = lens.height();
  double least = elementary::kPi / 2;
  if (lens.piece_width() < lens.width() || lens.piece_height() < lens.height()) return least;  // all directions
  for (const MapPoint& place : {MapPoint(0, h / 2), MapPoint(w, h / 2), MapPoint(w / 2, 0), MapPoint(w / 2, h)}) {
    const std::optional<DVector> d = lens.direction(place);
    const double angle = d ? angle_between(*d, DVector(0, 0, 1)) : lens.largest_angle();
    least = std::min(least, std::max(angle, kLeastHalfField));
  }
  return least;
}

}  // namespace

View make_up_view(const Scene& scene, const View& wanted) {
  return make_up_view(BoundingBall{scene.centre(), scene.bounding_radius()}, wanted.up, wanted);
}

View make_up_view(const BoundingBall& ball, const Vector& up, const View& wanted) {
  const FloatingPointMode mode;
  View view = wanted;
  const DVector from = Affine::turning({0, 1, 0}, DVector(up)).direction({0.5, 0.6, 1});
  const double radius = ball.radius;
  const double half = wanted.lens ? half_field(*wanted.lens) : std::min(wanted.field_angle / 2, elementary::kPi / 2);
  view.height = 2 * radius;
  const double distance =
      wanted.is_parallel ? 2 * radius : std::max(radius / elementary::sin(half), radius * (1 + kClosestApproach));
  const double scale = distance / std::sqrt(from.x * from.x + from.y * from.y + from.z * from.z);
  view.look_at = Vector(ball.centre);
  view.position = Vector(ball.centre + from * scale);
  return view;
}

std::vector<Light> make_up_lights(const Scene& scene) {
  return make_up_lights(BoundingBall{scene.centre(), scene.bounding_radius()}, {0, 1, 0});
}

std::vector<Light> make_up_lights(const BoundingBall& ball, const Vector& up) {
  const FloatingPointMode mode;
  const Affine upright = Affine::turning({0, 1, 0}, DVector(up));
  std::vector<Light> lights;
  for (int k = 0; k < kMadeUpLights; ++k) {
    const DVector offset(1.6 * kCosines[k], 1 + 0.3 * (k % 2), 1.6 * kCosines[(k + 6) % kMadeUpLights]);
    lights.push_back({Vector(ball.centre + upright.direction(offset) * ball.radius), Color{1, 1, 1}, 0.25f});
  }
  return lights;
}

}  // namespace facemap
