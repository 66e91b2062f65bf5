#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "scene/generators/chess_foot.h"
#include "scene/generators/chess_pieces.h"

namespace facemap::generators {
namespace {

// The horse is a row of loops: each spans from the back line to the front line of the side view and bulges to both
// sides by half the width. Knots of back and front line belong together one by one; x forward, y up.
struct Knot {
  glm::dvec2 back, front;
  double half_width;
};

constexpr Knot kKnots[] = {
    {{-0.235, 0.203}, {0.235, 0.203}, 0.215}, {{-0.245, 0.30}, {0.235, 0.30}, 0.205},
    {{-0.25, 0.42}, {0.205, 0.40}, 0.180},    {{-0.24, 0.56}, {0.150, 0.50}, 0.155},
    {{-0.215, 0.70}, {0.095, 0.58}, 0.140},   {{-0.17, 0.83}, {0.055, 0.645}, 0.130},
    {{-0.11, 0.94}, {0.045, 0.70}, 0.122},    {{-0.03, 1.02}, {0.075, 0.725}, 0.118},
    {{0.06, 1.045}, {0.130, 0.70}, 0.115},    {{0.14, 1.0}, {0.180, 0.66}, 0.105},
    {{0.21, 0.92}, {0.225, 0.625}, 0.092},    {{0.275, 0.83}, {0.265, 0.59}, 0.080},
    {{0.335, 0.745}, {0.305, 0.565}, 0.074},  {{0.375, 0.67}, {0.335, 0.56}, 0.066},
};

// A soft spot in the side view that moves the flank outwards by `height` (inwards if negative).
struct Feature {
  glm::dvec2 from, to;  // a segment; equal ends are a point
  double radius, height;
};

constexpr Feature kFeatures[] = {
    {{0.135, 0.905}, {0.135, 0.905}, 0.030, 0.030},   // eyeball
    {{0.095, 0.945}, {0.165, 0.945}, 0.022, 0.022},   // brow
    {{0.085, 0.905}, {0.105, 0.870}, 0.020, -0.020},  // hollow behind the eye
    {{0.11, 0.77}, {0.125, 0.79}, 0.075, 0.022},      // cheek
    {{0.34, 0.685}, {0.335, 0.675}, 0.016, -0.022},   // nostril
    {{0.355, 0.605}, {0.275, 0.645}, 0.011, -0.020},  // mouth
    {{0.23, 0.73}, {0.20, 0.79}, 0.035, -0.012},      // hollow below the cheek bone
};

double distance_to(const Feature& f, const glm::dvec2& p) {
  const glm::dvec2 d = f.to - f.from;
  const double length2 = dot(d, d);
  const double t = length2 > 0 ? std::clamp(dot(p - f.from, d) / length2, 0.0, 1.0) : 0.0;
  return length(p - f.from - t * d);
}

double relief(const glm::dvec2& p) {
  double sum = 0;
  for (const Feature& f : kFeatures) {
    const double d = distance_to(f, p) / f.radius;
    sum += f.height * elementary::exp(-d * d);
  }
  return sum;
}

// How far the mane stands out at `along` (0 at the foot, 1 at the muzzle) and `across` (0 at the crest): a ridge
// cut into locks that run down both sides.
double mane(double along, double across) {
  const double fade = std::clamp((along - 0.06) / 0.06, 0.0, 1.0) * std::clamp((0.60 - along) / 0.04, 0.0, 1.0);
  const double ridge = std::clamp(1.6 - 2.4 * across, 0.0, 1.0);
  const double lock = elementary::cos(2 * elementary::kPi * (along * 20 + 1.2 * across));
  return fade * ridge * (0.026 + 0.014 * lock);
}

// How far an ear lifts the point above (x, .) of the side view, `across` from 0 in the middle to 1 at the flank.
double ear(double x, double across) {
  const double u = (x - 0.035) / 0.036, v = (across - 0.46) / 0.20;
  return elementary::exp(-u * u - v * v);
}

// A point of the loop between `back` and `front`: `angle` is 0 at the front, pi at the back.
DVector loop_point(const glm::dvec2& back, const glm::dvec2& front, double half_width, double along, double angle) {
  const double c = elementary::cos(angle), s = elementary::sin(angle), across = std::abs(s);
  glm::dvec2 p = 0.5 * (back + front) + 0.5 * c * (front - back);
  const double z = half_width * across * (1 - 0.15 * c) + relief(p) * across;
  if (c < 0) {
    p += normalize(back - front) * mane(along, across) + glm::dvec2(0.02, 0.13) * ear(p.x, across);
  }
  return {p.x, p.y, s > 0 ? -z : z};
}

Solid make_horse(int rings_per_span, int sides) {
  Outline back, front, width;
  for (const Knot& knot : kKnots) {
    back.push_back(knot.back);
    front.push_back(knot.front);
    width.push_back({knot.half_width, 0});
  }
  back = smooth_curve(back, rings_per_span, false);
  front = smooth_curve(front, rings_per_span, false);
  width = smooth_curve(width, rings_per_span, false);
  Solid horse;
  Ring before;
  const std::size_t last = back.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    Ring ring;
    for (int j = 0; j < sides; ++j) {
      const double angle = 2 * elementary::kPi * j / sides;
      ring.push_back(horse.add_point(loop_point(back[i], front[i], width[i].x, double(i) / double(last), angle)));
    }
    if (i == 0) {
      cap_right(horse, ring, horse.add_point({(back[0].x + front[0].x) / 2, back[0].y, 0}), 0);
    } else {
      bridge(horse, before, ring, 1);
    }
    before = ring;
  }
  const glm::dvec2 tip = 0.5 * (back[last] + front[last]) + glm::dvec2(0.025, -0.02);
  cap(horse, before, horse.add_point({tip.x, tip.y, 0}), 1);
  return horse;
}

}  // namespace

Solid make_knight(const Carving& carving) {
  Profile foot = turned_foot(0.32, 0.27, carving.foot.detail);
  foot.line(0.255, 0.20).line(0, 0.20);
  Solid solid = lathe(foot, carving.foot.segments);
  solid.add(make_horse(carving.rings_per_span, carving.sides));
  return solid;
}

}  // namespace facemap::generators
