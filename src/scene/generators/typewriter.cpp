#include "math/elementary.h"
#include "scene/generators/typewriter_parts.h"

namespace facemap::generators {

Placement side_view(double x) { return turned_about_y(-elementary::kPi / 2, {x, 0, 0}); }

Placement plan_view(double y) { return turned_about_x(-elementary::kPi / 2, {0, y, 0}); }

Placement along_x(const DVector& origin) { return turned_about_z(-elementary::kPi / 2, origin); }

GeneratedScene make_typewriter(int detail) {
  SceneBuilder scene;
  add_frame(scene, detail);
  add_keyboard(scene, detail);
  add_type_basket(scene, detail);
  add_ribbon(scene, detail);
  add_carriage(scene, detail);
  scene.set_camera({-6.8f, 7.9f, 12.8f}, {0.02f, 1.36f, 0.78f}, 43);
  scene.add_light({-8, 9, 5}, {1, 0.97f, 0.92f}, 0.60f);
  scene.add_light({7, 6, 8}, {1, 0.97f, 0.92f}, 0.17f);
  scene.add_light({10, 6, -2}, {0.92f, 0.96f, 1}, 0.12f);
  scene.add_light({5, 8, -9}, {0.92f, 0.96f, 1}, 0.14f);
  scene.add_light({-4, 6, -10}, {0.92f, 0.96f, 1}, 0.10f);
  scene.add_light({-11, 4, -4}, {0.92f, 0.96f, 1}, 0.08f);
  scene.add_light({-1, 3, 13}, {1, 0.97f, 0.92f}, 0.10f);
  scene.add_light({1, 14, 2}, {1, 1, 1}, 0.10f);
  return scene.take();
}

}  // namespace facemap::generators
