#include <facemap/error.h>
#include <facemap/model.h>

#include <cmath>
#include <utility>

#include "scene/affine.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

bool is_finite(const DVector& v) { return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0; }

void check(const Affine& transform) {
  for (const DVector& column : {transform.x, transform.y, transform.z, transform.origin}) {
    if (!is_finite(column)) throw Error("transform: a value is not finite");
  }
  if (glm::dot(glm::cross(transform.x, transform.y), transform.z) == 0) throw Error("transform: it flattens the model");
}

void turn(std::vector<Corners>& corners) {
  for (Corners& triangle : corners) std::swap(triangle[1], triangle[2]);
}

void transform_mesh(Mesh& mesh, const Affine& transform) {
  for (Vector& position : mesh.positions) position = Vector(transform.point(DVector(position)));
  const Affine of_normals = transform.of_normals();
  for (Vector& normal : mesh.normals) normal = Vector(unit_or_zero(of_normals.direction(DVector(normal))));
  if (!transform.is_mirrored()) return;
  turn(mesh.triangles);
  turn(mesh.normal_corners);
  turn(mesh.texture_corners);
}

/// How many times as long lengths become, squared: the mean of three axes. 1 for what is a rotation but for rounding.
double squared_scale(const Affine& transform) {
  constexpr double kRounding = 0x1p-40;  // of products of many rotations
  const double mean =
      (glm::dot(transform.x, transform.x) + glm::dot(transform.y, transform.y) + glm::dot(transform.z, transform.z)) /
      3;
  return std::fabs(mean - 1) < kRounding ? 1 : mean;
}

void transform_light(Light& light, const Affine& transform, double scale) {
  light.position = Vector(transform.point(DVector(light.position)));
  light.direction = Vector(unit_or_zero(transform.direction(DVector(light.direction))));
  light.range *= std::sqrt(scale);
  if (light.has_falloff) light.intensity = static_cast<float>(light.intensity * scale);
}

void transform_camera(ModelCamera& camera, const Affine& transform, double scale) {
  camera.position = Vector(transform.point(DVector(camera.position)));
  camera.look_at = Vector(transform.point(DVector(camera.look_at)));
  camera.up = Vector(unit_or_zero(transform.direction(DVector(camera.up))));
  camera.height *= std::sqrt(scale);
}

}  // namespace

Model transformed(Model model, const Affine& transform) {
  const FloatingPointMode mode;
  check(transform);
  if (transform == Affine()) return model;
  const double scale = squared_scale(transform);
  transform_mesh(model.mesh, transform);
  for (Light& light : model.lights) transform_light(light, transform, scale);
  for (ModelCamera& camera : model.cameras) transform_camera(camera, transform, scale);
  if (model.up) model.up = Vector(unit_or_zero(transform.direction(DVector(*model.up))));
  return model;
}

}  // namespace facemap
