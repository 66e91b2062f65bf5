#include "render/shade.h"

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "render/lit_surface.h"

namespace facemap {
namespace {

double largest_coordinate(const DVector (&v)[3]) {
  double largest = 0;
  for (const DVector& a : v) largest = std::max({largest, std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  return largest;
}

}  // namespace

struct Shader::Surface {
  SurfacePoint point;
  DVector weights;        // of the corners
  DVector position;       // of the true point, rounded to double
  DVector normal;         // unit, on the camera's side
  bool is_moved = false;  // by the shadow terminator fix: lights not before the face are asked about `moved`
  Vector moved{0};
};

Shader::Shader(const Eye& eye, std::span<const simd::LightSource> lights, const ListsOfLights& lists,
               const Renderer::Options& options, Renderer::Statistics& statistics, const MaterialTable* materials)
    : eye_(eye),
      lights_(lights),
      lists_(lists),
      options_(options),
      statistics_(statistics),
      materials_(materials),
      surroundings_(options) {}

Shader::Surface Shader::surface_at(const Eye::Ray& ray, const Camera::Hit& hit) const {
  Surface surface;
  const auto id = static_cast<std::uint32_t>(hit.face);
  surface.point = {ray.origin, ray.direction, triangle_of(eye_.scene(), id), hit.face, hit.side};
  const Face face = eye_.scene().mesh().face(id);
  const FaceCorners corners = corners_of(eye_.scene().mesh(), id);
  const auto& [v, n] = corners;
  const DVector weights = barycentric(corners, point_on_plane(corners, DVector(ray.origin), DVector(ray.direction)));
  surface.weights = weights;
  surface.position = weighted(v, weights);
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

bool Shader::is_lit(std::size_t light, const Surface& surface) {
  if (!reaches(lights_[light], surface.position)) return false;
  ++statistics_.light_queries;
  // Departs: Hanika asks all lights about the lifted point. Where the face looks at the light there is no terminator,
  // and the lift may leave a shadow, or enter what stands on the face.
  const LightLists& lists = *lists_[light];
  return surface.is_moved && !lists.is_before(surface.point) ? lists.is_lit(surface.moved, &statistics_.light_tests)
                                                             : lists.is_lit(surface.point, &statistics_.light_tests);
}

// Calls add(light) for each light that reaches the surface, in order, and sets its bit.
template <class Add>
void Shader::for_each_lit(const Surface& surface, Sample& sample, const Add& add) {
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (!is_lit(i, surface)) continue;
    sample.lights[i / 8] = static_cast<std::uint8_t>(sample.lights[i / 8] | (1u << (i % 8)));
    add(lights_[i]);
  }
}

DVector Shader::white_radiance(const Surface& surface, Sample& sample) {
  DVector radiance = surroundings_.are_dark() ? DVector(0) : surroundings_.at(surface.normal);
  for_each_lit(surface, sample, [&](const simd::LightSource& light) {
    const auto [to_light, distance, share] = arrival(light, surface.position);
    if (!(distance > 0)) return;
    const double cosine = dot(surface.normal, to_light) / distance;
    if (!(cosine > 0)) return;
    radiance += DVector(light.color[0], light.color[1], light.color[2]) * (light.intensity * cosine * share);
  });
  return radiance;
}

SeenSurface Shader::seen_surface(const Surface& surface, const MapPoint& point, double step) const {
  SeenSurface seen;
  seen.face = static_cast<std::uint32_t>(surface.point.face);
  seen.weights = surface.weights;
  seen.normal = surface.normal;
  seen.is_behind = surface.point.side > 0;
  const Eye::Ray ray = {surface.point.origin, surface.point.direction};
  seen.camera = DVector(ray.origin);
  seen.rays.through = ray.direction;
  if (materials_ == nullptr || !materials_->has_textures(seen.face)) return seen;
  const DVector d(ray.direction);
  seen.rays = eye_.bundle(ray, point, step, dot(surface.position - seen.camera, d) / dot(d, d));
  return seen;
}

DVector Shader::material_radiance(const Surface& surface, const MapPoint& point, double step, Sample& sample) {
  const SeenSurface seen = seen_surface(surface, point, step);
  const SurfaceLook look = materials_->look(seen, frame_);
  LitSurface lit(seen, look, surface.position, surroundings_);
  for_each_lit(surface, sample, [&](const simd::LightSource& light) { lit.add(light); });
  return lit.radiance();
}

void Shader::shade(const MapPoint& point, double step, Sample& sample) {
  sample.lights.assign((lights_.size() + 7) / 8, 0);
  sample.color = options_.background;
  const Eye::Ray ray = eye_.ray(point);
  ++statistics_.camera_queries;
  const Camera::Hit hit = eye_.nearest(ray, &statistics_.camera_tests);
  sample.face = hit.face;
  if (!hit) return;

  const Surface surface = surface_at(ray, hit);
  const DVector radiance =
      materials_ == nullptr ? white_radiance(surface, sample) : material_radiance(surface, point, step, sample);
  sample.color = {static_cast<float>(radiance.x), static_cast<float>(radiance.y), static_cast<float>(radiance.z)};
}

bool Shader::see(const MapPoint& point, double step, SeenSurface& seen, SurfaceLook& look) {
  const Eye::Ray ray = eye_.ray(point);
  const Camera::Hit hit = eye_.nearest(ray, nullptr);
  if (!hit) return false;
  seen = seen_surface(surface_at(ray, hit), point, step);
  look = {};
  look.normal = seen.normal;
  if (materials_ != nullptr) look = materials_->look(seen, frame_);
  return true;
}

}  // namespace facemap
