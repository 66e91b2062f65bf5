#include <facemap/error.h>
#include <facemap/scene_file.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "math/elementary.h"
#include "parallel/executor.h"
#include "scene/affine.h"
#include "scene/vertex_bounds.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

constexpr int kGroundSides = 96;
constexpr double kGroundRadii = 24;     ///< of the models' bounding radius: from a usual place no edge is in sight
constexpr double kGroundGap = 0x1p-12;  ///< of that radius: what rests on the floor is not cut by its roundings

std::vector<std::uint32_t> every_face(const Mesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.face_count());
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = static_cast<std::uint32_t>(i);
  return faces;
}

/// The least height along `up` of a vertex that a triangle uses.
double lowest(const Mesh& mesh, const DVector& up) {
  double height = std::numeric_limits<double>::infinity();
  for (const Corners& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle)
      height = std::min(height, glm::dot(up, DVector(mesh.positions[vertex])));
  }
  return height;
}

bool is_finite(double x) { return x - x == 0; }

Material ground_material(const Color& color) {
  Material material;
  material.name = "ground";
  material.diffuse = Vector(color.r, color.g, color.b);
  return material;
}

}  // namespace

BoundingBall bounding_ball(const Mesh& mesh) {
  const FloatingPointMode mode;
  if (mesh.triangles.empty()) return {};
  const Executor executor(1);
  const std::vector<std::uint32_t> faces = every_face(mesh);
  const VertexBounds bounds(mesh, faces, executor);
  const auto [lower, upper] = bounds.box();
  BoundingBall ball;
  ball.centre = (DVector(lower) + DVector(upper)) * 0.5;
  ball.radius = std::sqrt(bounds.farthest_squared(ball.centre));
  return ball;
}

Model load_models(const std::vector<SceneModel>& models, const Vector& up, const ModelLimits& limits) {
  Model all;
  ModelLimits rest = limits;
  for (const SceneModel& wanted : models) {
    Model model = load_model(wanted.path, rest);
    Affine transform = wanted.transform;
    if (wanted.up) transform = transform * Affine::turning(DVector(*wanted.up), DVector(up));
    rest.max_faces -= std::min<std::uint64_t>(rest.max_faces, model.mesh.face_count());
    append(all, transformed(std::move(model), transform));
  }
  return all;
}

Model make_ground(const SceneGround& ground, const Model& models, const Vector& up) {
  const FloatingPointMode mode;
  const DVector axis = unit_or_zero(DVector(up));
  if (axis == DVector(0)) throw Error("ground: up has no direction");
  const BoundingBall ball = bounding_ball(models.mesh);
  const double height = ground.height.value_or(lowest(models.mesh, axis) - kGroundGap * ball.radius);
  const double radius = ground.radius.value_or(kGroundRadii * ball.radius);
  if (!is_finite(height) || !is_finite(radius)) throw Error("ground: a value is not finite");

  const Affine upright = Affine::turning({0, 1, 0}, axis);
  const DVector middle = ball.centre + axis * (height - glm::dot(axis, ball.centre));
  Model model;
  model.mesh.positions.push_back(Vector(middle));
  for (int k = 0; k < kGroundSides; ++k) {
    const double angle = 2 * elementary::kPi * k / kGroundSides;
    const DVector at(elementary::cos(angle) * radius, 0, -elementary::sin(angle) * radius);
    model.mesh.positions.push_back(Vector(middle + upright.direction(at)));
    const auto next = static_cast<std::uint32_t>(k + 1);
    model.mesh.triangles.push_back({0, next, next % kGroundSides + 1});
  }
  model.materials = {ground_material(ground.color)};
  model.mesh.triangle_materials.assign(model.mesh.face_count(), 0);
  model.objects = {"ground"};
  model.triangle_objects.assign(model.mesh.face_count(), 0);
  return model;
}

}  // namespace facemap
