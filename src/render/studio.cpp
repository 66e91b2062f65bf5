#include <facemap/affine.h>
#include <facemap/error.h>
#include <facemap/studio.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/elementary.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

constexpr double kFieldAngle = 30 * (elementary::kPi / 180);  ///< bottom to top: a long lens, no bulging
constexpr double kMargin = 1.16;                              ///< of the picture to the model in it

/// A direction from the model, for up +y: degrees around it from the front (+z) to the right, degrees above the floor.
DVector direction_at(double around, double above) {
  const double a = around * (elementary::kPi / 180), b = above * (elementary::kPi / 180);
  return {elementary::sin(a) * elementary::cos(b), elementary::sin(b), elementary::cos(a) * elementary::cos(b)};
}

/// What the lines of one coordinate of a picture ask of the place of a camera that looks along z, so that each point
/// (x, z) is within +-t z of it: x - t z <= at - t from for all, and the same to the other side.
class Fit {
 public:
  explicit Fit(double t) : t_(t) {}

  void add(double x, double z) {
    high_ = std::max(high_, x - t_ * z);
    low_ = std::max(low_, -x - t_ * z);
  }

  double nearest() const { return -(high_ + low_) / (2 * t_); }  ///< the z beyond which it must not go
  double middle() const { return (high_ - low_) / 2; }           ///< its x

 private:
  double t_;
  double high_ = -std::numeric_limits<double>::infinity(), low_ = high_;
};

struct Frame {
  DVector right, up, sight;
};

Frame frame_looking(const DVector& sight, const DVector& up) {
  const DVector right = glm::cross(sight, up);
  const DVector unit_right = right / std::sqrt(glm::dot(right, right));
  return {unit_right, glm::cross(unit_right, sight), sight};
}

/// The nearest place from which all vertices are in the picture.
View view_along(const Mesh& mesh, const Frame& frame, const DVector& centre, double radius, double aspect) {
  const double t = elementary::tan(kFieldAngle / 2) / kMargin;
  Fit across(t * aspect), upwards(t);
  for (const Corners& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      const DVector p = DVector(mesh.positions[vertex]) - centre;
      const double z = glm::dot(p, frame.sight);
      across.add(glm::dot(p, frame.right), z);
      upwards.add(glm::dot(p, frame.up), z);
    }
  }
  const double z = std::min({across.nearest(), upwards.nearest(), -radius / 8});
  const DVector aside = frame.right * across.middle() + frame.up * upwards.middle();
  View view;
  view.position = Vector(centre + aside + frame.sight * z);
  view.look_at = Vector(centre + aside);
  view.field_angle = kFieldAngle;
  view.projection = ProjectionKind::Plane;
  return view;
}

}  // namespace

Studio make_studio(const Mesh& mesh, const Vector& up, int width, int height) {
  const FloatingPointMode mode;
  if (mesh.triangles.empty()) throw Error("studio: no triangles");
  const Affine upright = Affine::turning({0, 1, 0}, DVector(up));
  const BoundingBall ball = bounding_ball(mesh);
  const auto light_at = [&](double around, double above, double distance, const Color& color, float intensity) {
    Light light;
    light.position = Vector(ball.centre + upright.direction(direction_at(around, above)) * (distance * ball.radius));
    light.color = color;
    light.intensity = intensity;
    return light;
  };
  Studio studio;
  const Frame frame = frame_looking(-upright.direction(direction_at(-32, 20)), upright.direction({0, 1, 0}));
  studio.view = view_along(mesh, frame, ball.centre, ball.radius, static_cast<double>(width) / height);
  studio.view.up = up;
  studio.lights = {
      light_at(20, 52, 5, {1, 0.97f, 0.92f}, 0.52f),
      light_at(-85, 30, 5, {0.86f, 0.92f, 1}, 0.2f),
      light_at(165, 40, 5, {1, 1, 1}, 0.2f),
  };
  studio.ground.color = {0.5f, 0.5f, 0.5f};
  studio.background = {0.3f, 0.31f, 0.33f};
  studio.sky_up = {0.25f, 0.26f, 0.28f};
  studio.sky_down = {0.14f, 0.13f, 0.12f};
  return studio;
}

}  // namespace facemap
