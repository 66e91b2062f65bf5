// One triangle, one light, two questions: what does the camera see, and is it lit?
#include <facemap/facemap.h>

#include <iostream>

int main() {
  facemap::Mesh mesh;
  mesh.positions = {{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  const facemap::Scene scene(std::move(mesh));

  const auto frame = facemap::SpaceVector::looking_at({0, 3, 4}, {0, 0, 0});
  const facemap::Camera camera(scene, frame, facemap::Camera::Options());
  const facemap::PointLight light(scene, {2, 5, 1});

  const facemap::Vector direction(0, -3, -4);
  const facemap::Camera::Hit hit = camera.nearest(direction);
  const bool is_lit = light.get_lighten_up(camera.surface_point(direction, hit));
  const bool is_lit_below = light.get_lighten_up({0, -1, 0});

  std::cout << "face " << hit.face << " at distance " << hit.depth << " is " << (is_lit ? "lit" : "dark") << ",\n"
            << "the point below it is " << (is_lit_below ? "lit" : "dark") << '\n';
}
