#include "math/elementary.h"
#include "scene/generators/lathe.h"
#include "scene/generators/typewriter_parts.h"

namespace facemap::generators {
namespace {

constexpr double kCheek = 3.92, kCheekWidth = 0.44;  // middle of a side wall, and how thick it is

// The outline of a side wall, as (z, y).
Outline cheek_outline(int detail) {
  const Outline knots{{-2.50, 0.20}, {-1.20, 0.13}, {1.00, 0.12},  {3.00, 0.12}, {4.20, 0.14}, {4.52, 0.40},
                      {4.25, 0.72},  {3.20, 0.98},  {2.00, 1.32},  {1.25, 1.80}, {0.70, 2.26}, {-0.20, 2.44},
                      {-1.40, 2.46}, {-2.30, 2.30}, {-2.62, 1.60}, {-2.66, 0.70}};
  return smooth_curve(knots, 4 * detail, true);
}

// What carries a ribbon spool, left or right of the type basket.
Outline spool_block_outline(int detail) {
  Outline outline{{-1.00, 1.00}, {1.12, 1.00}, {1.10, 1.20}};
  const Outline edge = smooth_curve({{1.02, 1.55}, {0.90, 1.90}, {0.62, 2.16}, {0.20, 2.25}}, 5 * detail, false);
  outline.insert(outline.end(), edge.begin(), edge.end());
  outline.push_back({-1.00, 2.25});
  return outline;
}

Solid make_foot(int detail) {
  Profile foot(0, 0, detail);
  foot.line(0.22, 0).arc(0.26, 0.04, 0.41421356237309503, 2).line(0.24, 0.105).line(0, 0.105);
  return lathe(foot, 32 * detail);
}

// The domed head of a screw, standing on y = 0.
Solid make_screw(int detail) {
  Profile screw(0, 0, detail);
  screw.line(0.085, 0).line(0.085, 0.025).arc(0, 0.055, 0.25, 5);
  return lathe(screw, 24 * detail);
}

void add_screws(SceneBuilder& scene, int detail) {
  constexpr double kPlaces[][2] = {{-2.2, 1.9}, {-2.2, 0.5}, {0.6, 1.7}, {1.4, 0.5}, {3.9, 0.45}};
  const double side = kCheek + kCheekWidth / 2 + 0.004;
  const Solid screw = make_screw(detail);
  scene.start_part("screws");
  for (const auto& [z, y] : kPlaces) {
    scene.place(screw, along_x({side, y, z}));
    scene.place(screw, composed(turned_about_y(elementary::kPi), along_x({side, y, -z})));
  }
}

}  // namespace

void add_frame(SceneBuilder& scene, int detail) {
  scene.start_part("frame");
  for (double x : {-kCheek, kCheek}) {
    scene.place(extrude(cheek_outline(detail), kCheekWidth, 0.07), side_view(x));
    for (double z : {-2.2, 3.9}) scene.place(make_foot(detail), moved({x, 0, z}));
  }
  scene.place(box({-3.69, 0.16, -2.45}, {3.69, 0.30, 4.20}, 0.02));
  scene.place(box({-3.69, 0.31, 3.98}, {3.69, 0.70, 4.26}, 0.08));    // front rail
  scene.place(box({-3.69, 0.31, -2.40}, {3.69, 1.98, -1.06}, 0.05));  // rear block, below the carriage
  // The maker's plate on the front rail.
  scene.place(extrude(rounded_rectangle({-0.9, 0.42}, {0.9, 0.60}, 0.08, 6 * detail), 0.03, 0.01),
              moved({0, 0, 4.279}));
  for (double x : {-2.83, 2.83}) scene.place(extrude(spool_block_outline(detail), 1.72, 0.05), side_view(x));
  add_screws(scene, detail);
}

}  // namespace facemap::generators
