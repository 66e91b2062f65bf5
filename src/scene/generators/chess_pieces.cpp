#include "scene/generators/chess_pieces.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "scene/generators/chess_foot.h"
#include "scene/generators/lathe.h"

namespace facemap::generators {
namespace {

// A thin round collar at the current height, of the given greatest radius; goes on at `inner`.
void add_collar(Profile& profile, double outer, double height, double inner) {
  const double y = profile.height();
  profile.line(outer - height / 2, y).arc(outer - height / 2, y + height, 1, 3).line(inner, y + height);
}

// The rim of a crown: sharp points with round gaps between them.
struct Scallops {
  int points;
  double depth;

  double operator()(double angle) const { return -depth * std::abs(elementary::sin(angle * points / 2.0)); }
};

Ring scalloped_circle(Solid& solid, double radius, double height, const Scallops& scallops, int segments) {
  const Ring ring = circle(solid, radius, height, segments);
  for (int j = 0; j < segments; ++j) {
    solid.points[ring[j]].y += scallops(2 * elementary::kPi * j / segments);
  }
  return ring;
}

// The wall of a rook's top: merlons and gaps by turns, `inner` and `outer` its loops at the height of the gaps.
void add_battlements(Solid& solid, const Ring& inner, const Ring& outer, int merlons, double height) {
  const int n = static_cast<int>(inner.size()), period = n / merlons, gap = period / 4;
  const auto is_high = [&](int j) { return (j % n + n) % n % period >= gap; };
  Ring high_inner(n), high_outer(n);
  for (int j = 0; j < n; ++j) {
    if (!is_high(j) && !is_high(j - 1)) continue;
    high_inner[j] = solid.add_point(solid.points[inner[j]] + DVector(0, height, 0));
    high_outer[j] = solid.add_point(solid.points[outer[j]] + DVector(0, height, 0));
  }
  for (int j = 0; j < n; ++j) {
    const int k = (j + 1) % n;
    if (is_high(j)) {
      solid.add_quad(outer[j], outer[k], high_outer[k], high_outer[j], 1);
      solid.add_quad(high_outer[j], high_outer[k], high_inner[k], high_inner[j], 0);
      solid.add_quad(high_inner[j], high_inner[k], inner[k], inner[j], 1);
    } else {
      solid.add_quad(outer[j], outer[k], inner[k], inner[j], 0);
    }
    if (is_high(j) && !is_high(j - 1)) solid.add_quad(outer[j], high_outer[j], high_inner[j], inner[j], 0);
    if (!is_high(j) && is_high(j - 1)) solid.add_quad(inner[j], high_inner[j], high_outer[j], outer[j], 0);
  }
}

// The egg of a bishop's mitre, cut by planes that lean towards +x.
struct Mitre {
  double radius, centre, below, above;

  double y(double angle) const { return centre + (angle < 0 ? below : above) * elementary::sin(angle); }
  double r(double angle) const { return radius * elementary::cos(angle); }

  // Where the meridian at `azimuth` meets the plane y = height + slope x.
  DVector meet(double azimuth, double height, double slope) const {
    const double c = elementary::cos(azimuth);
    double low = -elementary::kPi / 2, high = elementary::kPi / 2;
    for (int step = 0; step < 48; ++step) {
      const double middle = (low + high) / 2;
      (y(middle) < height + slope * r(middle) * c ? low : high) = middle;
    }
    return {r(low) * c, y(low), -r(low) * elementary::sin(azimuth)};
  }

  Ring ring(Solid& solid, double height, double slope, int segments) const {
    Ring ring;
    for (int j = 0; j < segments; ++j) {
      ring.push_back(solid.add_point(meet(2 * elementary::kPi * j / segments, height, slope)));
    }
    return ring;
  }
};

constexpr double kSlitSlope = 0.75, kSlitGape = 0.20;

// The slit: a wedge between two half planes that meet in the diameter x = 0 of the mitre at `height`. `upper`
// becomes the loop above it; `lower` is the one below, equal to it on the far half.
Ring open_slit(Solid& solid, const Mitre& mitre, const Ring& lower, double height) {
  const int n = static_cast<int>(lower.size()), quarter = n / 4;
  Ring upper = lower, lower_lip, upper_lip, hinge;
  for (int i = -quarter; i <= quarter; ++i) {
    const int j = (i + n) % n;
    const bool end = i == -quarter || i == quarter;
    if (!end) upper[j] = solid.add_point(mitre.meet(2 * elementary::kPi * j / n, height, kSlitSlope + kSlitGape));
    lower_lip.push_back(lower[j]);
    upper_lip.push_back(upper[j]);
    hinge.push_back(end ? lower[j] : solid.add_point({0, height, solid.points[lower[j]].z}));
  }
  const std::size_t last = hinge.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    if (i + 1 < last) solid.add_triangle(lower_lip[i], lower_lip[i + 1], hinge[i + 1], 0);
    if (i > 0) solid.add_triangle(lower_lip[i], hinge[i + 1], hinge[i], 0);
    if (i + 1 < last) solid.add_triangle(upper_lip[i], hinge[i + 1], upper_lip[i + 1], 0);
    if (i > 0) solid.add_triangle(upper_lip[i], hinge[i], hinge[i + 1], 0);
  }
  return upper;
}

Outline cross_outline() {
  const double arm = 0.028, end = 0.052, reach = 0.11, top = 0.25, middle = 0.14;
  const Outline right{{end, 0},  {arm, middle - arm}, {reach, middle - end}, {reach, middle + end}, {arm, middle + arm},
                      {end, top}};
  Outline outline = right;
  for (auto p = right.rbegin(); p != right.rend(); ++p) outline.push_back({-p->x, p->y});
  return outline;
}

}  // namespace

Solid make_pawn(const Turning& turning) {
  Profile profile = turned_foot(0.28, 0.20, turning.detail);
  profile.curve(0.085, 0.24, 0.08, 0.50, 6);
  add_collar(profile, 0.165, 0.035, 0.105);
  profile.curve(0.08, 0.55, 0.075, 0.575, 3).sphere(0.70, 0.15, 0, 14);
  return lathe(profile, turning.segments);
}

Solid make_rook(const Turning& turning) {
  Profile profile = turned_foot(0.32, 0.24, turning.detail);
  profile.curve(0.15, 0.28, 0.155, 0.66, 6);
  add_collar(profile, 0.225, 0.035, 0.18);
  profile.curve(0.185, 0.75, 0.235, 0.77, 4).line(0.24, 0.78).line(0.24, 0.90);
  Solid solid;
  const Ring outer = lathe_onto(solid, profile, turning.segments, {});
  const Ring inner = circle(solid, 0.165, 0.90, turning.segments);
  add_battlements(solid, inner, outer, 6, 0.10);
  Profile floor(0.165, 0.90, turning.detail);
  floor.line(0.165, 0.86).line(0, 0.84);
  lathe_onto(solid, floor, turning.segments, inner);
  return solid;
}

Solid make_bishop(const Turning& turning) {
  Profile profile = turned_foot(0.32, 0.24, turning.detail);
  profile.curve(0.095, 0.30, 0.085, 0.72, 7);
  add_collar(profile, 0.19, 0.035, 0.13);
  profile.line(0.12, 0.775);
  add_collar(profile, 0.155, 0.03, 0.10);
  Solid solid;
  const Ring neck = lathe_onto(solid, profile, turning.segments, {});
  const Mitre mitre{0.168, 0.935, 0.145, 0.27};
  const int n = turning.segments, below = 8 * turning.detail, above = 6 * turning.detail;
  const double bottom = profile.height() + 0.012, slit = 1.0, top = 1.19;
  Ring ring = neck;
  for (int i = 0; i <= below; ++i) {
    const double t = double(i) / below;
    const Ring next = mitre.ring(solid, bottom + t * (slit - bottom), kSlitSlope * t * t, n);
    bridge(solid, ring, next, 1);
    ring = next;
  }
  ring = open_slit(solid, mitre, ring, slit);
  for (int i = 1; i <= above; ++i) {
    const double t = double(i) / above;
    const Ring next = mitre.ring(solid, slit + t * (top - slit), (kSlitSlope + kSlitGape) * (1 - t), n);
    bridge(solid, ring, next, 1);
    ring = next;
  }
  Profile finial(mitre.meet(0, top, 0).x, top, turning.detail);
  finial.line(0.03, top + 0.012).sphere(1.243, 0.052, 0, 7);
  lathe_onto(solid, finial, n, ring);
  return solid;
}

Solid make_queen(const Turning& turning) {
  Profile profile = turned_foot(0.345, 0.26, turning.detail);
  profile.curve(0.105, 0.32, 0.095, 0.92, 8);
  add_collar(profile, 0.205, 0.035, 0.15);
  profile.line(0.14, 0.975);
  add_collar(profile, 0.17, 0.03, 0.115);
  profile.curve(0.12, 1.14, 0.185, 1.27, 6);
  Solid solid;
  const Ring neck = lathe_onto(solid, profile, turning.segments, {});
  const Scallops scallops{8, 0.075};
  const Ring rim = scalloped_circle(solid, 0.218, 1.385, scallops, turning.segments);
  const Ring inner_rim = scalloped_circle(solid, 0.188, 1.385, scallops, turning.segments);
  bridge(solid, neck, rim, 1);
  bridge(solid, rim, inner_rim, 0);
  Profile inside(0.188, 1.385, turning.detail);
  inside.line(0.15, 1.27).curve(0.13, 1.29, 0.05, 1.36, 5).sphere(1.415, 0.062, 0, 7);
  lathe_onto(solid, inside, turning.segments, inner_rim);
  return solid;
}

Solid make_king(const Turning& turning) {
  Profile profile = turned_foot(0.36, 0.27, turning.detail);
  profile.curve(0.115, 0.34, 0.105, 1.02, 8);
  add_collar(profile, 0.215, 0.035, 0.16);
  profile.line(0.15, 1.075);
  add_collar(profile, 0.18, 0.03, 0.125);
  profile.curve(0.125, 1.26, 0.20, 1.42, 7).arc(0.19, 1.445, 0.5, 3);
  profile.curve(0.12, 1.475, 0.055, 1.50, 5).line(0.055, 1.52).line(0, 1.52);
  Solid solid = lathe(profile, turning.segments);
  solid.add(placed(extrude(cross_outline(), 0.07, 0.012), turned_about_y(elementary::kPi / 2, {0, 1.523, 0})));
  return solid;
}

}  // namespace facemap::generators
