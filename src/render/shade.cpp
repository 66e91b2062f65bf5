#include "render/shade.h"

#include <algorithm>
#include <cmath>

#include "math/dvector.h"
#include "math/exact_sign.h"

namespace facemap {
namespace {

double largest_coordinate(const DVector (&v)[3]) {
  double largest = 0;
  for (const DVector& a : v) largest = std::max({largest, std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  return largest;
}

// Where the line from K along d meets the plane; a ray so grazing that its slope rounds to zero gets the corner.
DVector point_on_plane(const DVector& K, const DVector& d, const DVector& corner, const DVector& n) {
  const double t = dot(n, corner - K) / dot(n, d);
  return std::isfinite(t) ? K + d * t : corner;
}

// Weights of the corners at a point of the plane, not below 0 and of sum 1.
DVector barycentric(const DVector (&v)[3], const DVector& n, const DVector& p) {
  DVector weights(std::max(0.0, dot(n, cross(v[2] - v[1], p - v[1]))),
                  std::max(0.0, dot(n, cross(v[0] - v[2], p - v[2]))),
                  std::max(0.0, dot(n, cross(v[1] - v[0], p - v[0]))));
  const double sum = weights.x + weights.y + weights.z;
  return sum > 0 ? weights * (1 / sum) : DVector(1.0 / 3);
}

}  // namespace

struct Shader::Surface {
  SurfacePoint point;
  DVector position;       // of the true point, rounded to double
  DVector normal;         // unit, on the camera's side
  bool is_moved = false;  // by the shadow terminator fix: `moved` is asked instead of the true point
  Vector moved{0};
};

Shader::Shader(const Camera& camera, std::span<const PointLight> lights, const Renderer::Options& options,
               Renderer::Statistics& statistics)
    : camera_(camera), lights_(lights), options_(options), statistics_(statistics) {}

Shader::Surface Shader::surface_at(const Vector& direction, const Camera::Hit& hit) const {
  Surface surface;
  surface.point = camera_.surface_point(direction, hit);
  const Face face = camera_.scene().mesh().face(static_cast<std::size_t>(hit.face));
  const DVector v[3] = {DVector(face.vertices[0]), DVector(face.vertices[1]), DVector(face.vertices[2])};
  const DVector n = cross(v[1] - v[0], v[2] - v[0]);
  const DVector weights = barycentric(v, n, point_on_plane(DVector(camera_.position()), DVector(direction), v[0], n));
  surface.position = v[0] * weights.x + v[1] * weights.y + v[2] * weights.z;
  // s < 0: the face is turned towards the camera, its normal with it.
  const DVector towards_camera = normalized(n) * (hit.side < 0 ? 1.0 : -1.0);
  surface.normal = towards_camera;
  if (options_.normals == Renderer::Normals::Flat) return surface;

  DVector corner_normals[3];
  DVector sum(0);
  for (int i = 0; i < 3; ++i) {
    corner_normals[i] = normalized(DVector(face.normals[i]));
    if (corner_normals[i] == DVector(0)) return surface;
    sum += corner_normals[i];
  }
  // All three are turned together: a file's normals may point to either side of the face.
  const double turn = dot(sum, towards_camera) < 0 ? -1 : 1;
  DVector smooth(0);
  DVector shift(0);
  for (int i = 0; i < 3; ++i) {
    const DVector normal = corner_normals[i] * turn;
    smooth += normal * weights[i];
    // Hanika 2021: lift the point to the planes of the corner normals that it lies below.
    const double below = std::min(0.0, dot(surface.position - v[i], normal));
    shift -= normal * (below * weights[i]);
  }
  const DVector unit = normalized(smooth);
  if (unit == DVector(0)) return surface;
  surface.normal = unit;
  if (options_.shadow_terminator_fix && length(shift) > kLeastLift * largest_coordinate(v)) {
    // The lift may still be lost in rounding and leave the point on its face or below: then it is no lift.
    surface.moved = Vector(surface.position + shift);
    surface.is_moved = side(face.vertices, surface.moved) == hit.side;
  }
  return surface;
}

bool Shader::is_lit(const PointLight& light, const Surface& surface) {
  ++statistics_.light_queries;
  return surface.is_moved ? light.get_lighten_up(surface.moved, &statistics_.light_tests)
                          : light.get_lighten_up(surface.point, &statistics_.light_tests);
}

void Shader::shade(const MapPoint& point, Sample& sample) {
  sample.lights.assign((lights_.size() + 7) / 8, 0);
  sample.color = options_.background;
  const Vector direction = camera_.direction_through(point);
  ++statistics_.camera_queries;
  const Camera::Hit hit = camera_.nearest(direction, &statistics_.camera_tests);
  sample.face = hit.face;
  sample.depth = hit.depth;
  if (!hit) return;

  const Surface surface = surface_at(direction, hit);
  DVector radiance(0);
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const PointLight& light = lights_[i];
    if (!is_lit(light, surface)) continue;
    sample.lights[i / 8] = static_cast<std::uint8_t>(sample.lights[i / 8] | (1u << (i % 8)));
    const DVector to_light = DVector(light.position()) - surface.position;
    const double squared = dot(to_light, to_light);
    if (!(squared > 0)) continue;
    const double cosine = dot(surface.normal, to_light) / std::sqrt(squared);
    if (!(cosine > 0)) continue;
    const double strength =
        light.intensity * cosine * (options_.falloff == Renderer::Falloff::InverseSquare ? 1 / squared : 1);
    radiance += DVector(light.color.r, light.color.g, light.color.b) * strength;
  }
  sample.color = {static_cast<float>(radiance.x), static_cast<float>(radiance.y), static_cast<float>(radiance.z)};
}

}  // namespace facemap
