#include <algorithm>
#include <cmath>

#include "scene/generators/lathe.h"
#include "scene/generators/typewriter_parts.h"

namespace facemap::generators {
namespace {

constexpr int kAroundSpool = 64;
constexpr double kSpoolX = 2.75, kSpoolZ = -0.10, kSpoolFoot = 2.254;

Solid make_spool(int segments, int detail) {
  Profile spool(0, 0, detail);
  spool.line(0.64, 0).arc(0.64, 0.05, 1, 4).line(0.50, 0.06).line(0.50, 0.40).line(0.64, 0.41).arc(0.64, 0.46, 1, 4);
  spool.line(0.50, 0.47).curve(0.36, 0.44, 0.22, 0.44, 5).arc(0.22, 0.50, -0.2, 3).curve(0.20, 0.56, 0.11, 0.56, 4);
  spool.line(0.11, 0.63).arc(0, 0.69, 0.45, 5);
  return lathe(spool, segments);
}

// The ribbon in plan view, as (x, -z): from the back of one spool through the guide to the other.
Outline ribbon_line(int detail) {
  const Outline left{{-2.70, 0.62}, {-2.10, 0.632}, {-1.20, 0.648}, {-0.45, 0.665}, {0, 0.69}};
  Outline knots = left;
  for (std::size_t i = left.size() - 1; i-- > 0;) knots.push_back({-left[i].x, left[i].y});
  return smooth_curve(knots, 5 * detail, false);
}

// The ribbon rises from the spools to the height of the platen's front: its height over the spools' at `x`.
double ribbon_lift(double x) {
  constexpr double kFrom = 2.2, kTo = 0.5, kLift = 0.30;
  const double t = std::clamp((kFrom - std::abs(x)) / (kFrom - kTo), 0.0, 1.0);
  return kLift * t * t * (3 - 2 * t);
}

Solid make_ribbon(int detail) {
  constexpr double kThickness = 0.022, kWidth = 0.26;
  Solid ribbon = sheet(ribbon_line(detail), kThickness, kWidth);
  for (DVector& p : ribbon.points) p.z += ribbon_lift(p.x);
  return ribbon;
}

}  // namespace

void add_ribbon(SceneBuilder& scene, int detail) {
  const Solid spool = make_spool(kAroundSpool * detail, detail);
  scene.start_part("spools");
  for (double x : {-kSpoolX, kSpoolX}) scene.place(spool, moved({x, kSpoolFoot, kSpoolZ}));
  scene.start_part("ribbon");
  scene.place(make_ribbon(detail), plan_view(2.48));
  scene.start_part("ribbon_guide");
  const Outline fork{{-0.46, 1.95}, {0.46, 1.95},  {0.46, 3.00},  {0.36, 3.00},
                     {0.36, 2.12},  {-0.36, 2.12}, {-0.36, 3.00}, {-0.46, 3.00}};
  scene.place(extrude(fork, 0.05, 0.012), moved({0, 0, -0.59}));
}

}  // namespace facemap::generators
