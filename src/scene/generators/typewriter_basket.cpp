#include "math/elementary.h"
#include "scene/generators/lathe.h"
#include "scene/generators/typewriter_parts.h"

namespace facemap::generators {
namespace {

constexpr double kCentreZ = -0.75;  // the arcs of the basket lie about this point of x = 0
constexpr int kBars = 43;
constexpr double kHalfAngle = 1.50;  // of the rings
constexpr double kSpread = 1.32;     // the outermost bars lie so far, in radians, from straight ahead

// A type bar in its own plane, as (distance from the basket's centre, height): pivot inside, type head outside.
Outline type_bar_outline(int detail) {
  const int n = 7 * detail;
  Outline lower = smooth_curve({{0.53, 1.472}, {0.75, 1.50}, {1.10, 1.60}, {1.48, 1.70}}, n, false);
  Outline upper = smooth_curve({{1.40, 1.77}, {1.10, 1.70}, {0.75, 1.61}, {0.54, 1.582}}, n, false);
  Outline outline{{0.50, 1.47}};
  outline.insert(outline.end(), lower.begin(), lower.end());
  outline.push_back({1.585, 1.70});
  outline.push_back({1.585, 1.92});
  outline.push_back({1.40, 1.92});
  outline.insert(outline.end(), upper.begin(), upper.end());
  outline.push_back({0.51, 1.58});
  return outline;
}

// A rectangle with its corners cut.
Outline bevelled_section(const glm::dvec2& lower, const glm::dvec2& upper, double bevel) {
  const double b = bevel;
  return {{lower.x + b, lower.y}, {upper.x - b, lower.y}, {upper.x, lower.y + b}, {upper.x, upper.y - b},
          {upper.x - b, upper.y}, {lower.x + b, upper.y}, {lower.x, upper.y - b}, {lower.x, lower.y + b}};
}

}  // namespace

void add_type_basket(SceneBuilder& scene, int detail) {
  const Placement to_basket = moved({0, 0, kCentreZ});
  const double front = -elementary::kPi / 2;
  const auto place_ring = [&](double inner, double outer, double bottom, double top, double bevel) {
    const Outline section = bevelled_section({inner, bottom}, {outer, top}, bevel);
    scene.place(sweep(section, front - kHalfAngle, front + kHalfAngle, 40 * detail), to_basket);
  };
  scene.start_part("type_basket");
  place_ring(0.28, 0.66, 1.20, 1.44, 0.03);  // segment: the pivots
  place_ring(1.63, 1.77, 1.58, 1.74, 0.03);  // rest of the type heads
  place_ring(1.80, 1.92, 1.00, 1.98, 0.04);  // shield
  scene.start_part("type_bars");
  const Solid type_bar = extrude(type_bar_outline(detail), 0.027, 0.006);
  for (int i = 0; i < kBars; ++i) {
    const double angle = kSpread * (2.0 * i / (kBars - 1) - 1);
    scene.place(type_bar, composed(to_basket, turned_about_y(angle + front)));
  }
}

}  // namespace facemap::generators
