#include "scene/generators/scene_builder.h"

namespace facemap::generators {

void SceneBuilder::start_part(const std::string& name) { scene_.parts.push_back({name, scene_.mesh.triangles.size()}); }

void SceneBuilder::place(const Solid& solid, const Placement& placement) {
  Mesh& mesh = scene_.mesh;
  const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
  for (const DVector& p : solid.points) mesh.positions.push_back(Vector(placement(p)));
  const int second = placement.mirrors() ? 2 : 1, third = 3 - second;
  for (const Corners& t : solid.triangles) {
    mesh.triangles.push_back({t[0] + shift, t[second] + shift, t[third] + shift});
  }
  scene_.smoothing_groups.insert(scene_.smoothing_groups.end(), solid.groups.begin(), solid.groups.end());
}

void SceneBuilder::set_camera(const Vector& position, const Vector& look_at, float field_angle_deg) {
  scene_.camera_position = position;
  scene_.look_at = look_at;
  scene_.field_angle_deg = field_angle_deg;
}

void SceneBuilder::add_light(const Vector& position, const Vector& color, float intensity) {
  scene_.lights.push_back({position, color, intensity});
}

}  // namespace facemap::generators
