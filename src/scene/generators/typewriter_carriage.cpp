#include <algorithm>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "scene/generators/lathe.h"
#include "scene/generators/typewriter_parts.h"

namespace facemap::generators {
namespace {

constexpr double kAxisY = 2.98, kAxisZ = -1.38;  // of the platen
constexpr double kPlatenRadius = 0.48, kPlatenEnd = 3.10;
constexpr double kPaperThickness = 0.012;
constexpr double kQuarter = 0.41421356237309503;  // bulge of a quarter circle

Solid make_platen(int segments, int detail) {
  Profile platen(0, -kPlatenEnd, detail);
  platen.line(kPlatenRadius - 0.03, -kPlatenEnd).arc(kPlatenRadius, 0.03 - kPlatenEnd, kQuarter, 2);
  platen.line(kPlatenRadius, kPlatenEnd - 0.03).arc(kPlatenRadius - 0.03, kPlatenEnd, kQuarter, 2).line(0, kPlatenEnd);
  return lathe(platen, segments);
}

// A turning knob with flutes around, standing on y = 0.
Solid make_knob(int segments, int detail) {
  constexpr int kFlutes = 24;
  constexpr double kFluteDepth = 0.018, kRim = 0.40, kSmooth = 0.34;
  Profile profile(0, 0, detail);
  profile.line(0.16, 0).line(0.16, 0.06).line(0.36, 0.08).arc(kRim, 0.12, kQuarter, 3);
  profile.line(kRim, 0.34).arc(0.33, 0.41, kQuarter, 4).curve(0.20, 0.43, 0.12, 0.38, 4).line(0, 0.37);
  Solid knob = lathe(profile, segments);
  for (DVector& p : knob.points) {
    const double radius = length(DVector(p.x, 0, p.z));
    if (radius < kSmooth) continue;
    const double depth = kFluteDepth * std::min(1.0, (radius - kSmooth) / (kRim - kSmooth));
    const double flute = depth * elementary::cos(kFlutes * elementary::atan2(p.z, p.x));
    p.x *= 1 + flute / radius;
    p.z *= 1 + flute / radius;
  }
  return knob;
}

// A rubber ring that turns on the paper bail.
Solid make_bail_roller(int segments, int detail) {
  constexpr double kBore = 0.042, kRadius = 0.11, kHalf = 0.12;
  Profile profile(kBore, -kHalf, detail);
  profile.line(0.09, -kHalf).arc(kRadius, 0.02 - kHalf, kQuarter, 3).line(kRadius, kHalf - 0.02);
  profile.arc(0.09, kHalf, kQuarter, 3).line(kBore, kHalf);
  Solid roller;
  const Ring first = circle(roller, kBore, -kHalf, segments);
  const Ring last = lathe_onto(roller, profile, segments, first);
  bridge(roller, last, first, 3);
  return roller;
}

// The toothed rack along the carriage, as (x, y).
Outline rack_outline() {
  constexpr int kTeeth = 110;
  constexpr double kFrom = -3.1, kTo = 3.1, kFoot = 2.24, kRoot = 2.33, kTip = 2.375;
  constexpr double kPitch = (kTo - kFrom) / kTeeth;
  Outline outline{{kFrom, kFoot}, {kTo, kFoot}};
  for (int i = kTeeth; i > 0; --i) {
    outline.push_back({kFrom + i * kPitch, kRoot});
    outline.push_back({kFrom + (i - 0.3) * kPitch, kTip});
    outline.push_back({kFrom + (i - 0.5) * kPitch, kTip});
  }
  outline.push_back({kFrom, kRoot});
  return outline;
}

// Paper, as (z, y): around the front of the platen, then straight up and back, curling a little.
Outline paper_line(int detail) {
  constexpr double kRadius = kPlatenRadius + 0.006 + kPaperThickness, kFrom = -1.1, kLeave = 0.42, kLength = 2.3,
                   kCurl = 0.28;
  Outline line;
  const int around = 12 * detail, up = 12 * detail;
  for (int k = 0; k <= around; ++k) {
    const double a = kFrom + (kLeave - kFrom) * k / around;
    line.push_back({kAxisZ + kRadius * elementary::cos(a), kAxisY + kRadius * elementary::sin(a)});
  }
  for (int k = 0; k < up; ++k) {
    const double a = kLeave + kCurl * (k + 0.5) / up;
    line.push_back(line.back() + kLength / up * glm::dvec2(-elementary::sin(a), elementary::cos(a)));
  }
  return line;
}

// A spring that holds the paper to the platen, as (z, y).
Outline finger_line(int detail) {
  constexpr double kRadius = kPlatenRadius + 0.044, kFrom = -1.15, kTo = 0.55;
  Outline line;
  const int n = 16 * detail;
  for (int k = 0; k <= n; ++k) {
    const double a = kFrom + (kTo - kFrom) * k / n;
    line.push_back({kAxisZ + kRadius * elementary::cos(a), kAxisY + kRadius * elementary::sin(a)});
  }
  return line;
}

Outline end_plate_outline(int detail) {
  const Outline knots{{-2.20, 2.30}, {-0.80, 2.30}, {-0.74, 2.57}, {-0.86, 3.05},
                      {-1.05, 3.38}, {-1.45, 3.50}, {-1.90, 3.34}, {-2.20, 2.90}};
  return smooth_curve(knots, 4 * detail, true);
}

std::vector<DVector> bent_path(const DVector& a, const DVector& b, const DVector& c, int segments) {
  std::vector<DVector> path;
  for (int k = 0; k <= segments; ++k) {
    const double t = double(k) / segments;
    path.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c);
  }
  return path;
}

void add_return_lever(SceneBuilder& scene, int detail) {
  scene.start_part("return_lever");
  const int n = 14 * detail;
  const std::vector<DVector> path = bent_path({-3.256, 2.62, -0.95}, {-4.45, 2.55, -0.80}, {-4.85, 3.70, 0.10}, n);
  std::vector<double> radii;
  for (int k = 0; k <= n; ++k) radii.push_back(0.055 + 0.045 * double(k) / n);
  scene.place(bar(path, radii, 17 * detail));
}

void add_paper_bail(SceneBuilder& scene, int detail) {
  constexpr double kY = 3.42, kZ = -0.80, kReach = 2.9;
  scene.start_part("paper_bail");
  Profile rod(0, -kReach, detail);
  rod.line(0.035, -kReach).line(0.035, kReach).line(0, kReach);
  scene.place(lathe(rod, 16 * detail), along_x({0, kY, kZ}));
  const Solid roller = make_bail_roller(40 * detail, detail);
  for (double x : {-1.2, 1.2}) scene.place(roller, along_x({x, kY, kZ}));
  for (double x : {-kReach - 0.06, kReach + 0.06}) {
    const Outline arm{{-1.62, 3.53}, {-1.20, 3.49}, {-0.80, 3.37}, {-0.74, 3.42},
                      {-0.76, 3.48}, {-1.15, 3.61}, {-1.62, 3.65}};
    scene.place(extrude(arm, 0.06, 0.015), side_view(x));
  }
}

}  // namespace

void add_carriage(SceneBuilder& scene, int detail) {
  scene.start_part("platen");
  scene.place(make_platen(108 * detail, detail), along_x({0, kAxisY, kAxisZ}));
  scene.start_part("platen_knobs");
  const Solid knob = make_knob(144 * detail, detail);
  scene.place(knob, along_x({3.29, kAxisY, kAxisZ}));
  scene.place(knob, composed(turned_about_y(elementary::kPi), along_x({3.29, kAxisY, -kAxisZ})));
  scene.start_part("carriage");
  for (double x : {-3.19, 3.19}) scene.place(extrude(end_plate_outline(detail), 0.12, 0.03), side_view(x));
  scene.place(box({-3.60, 2.02, -2.25}, {3.60, 2.22, -1.15}, 0.03));
  const Outline table{{-1.86, 3.42}, {-1.80, 3.40}, {-2.30, 4.62}, {-2.36, 4.62}};
  scene.place(extrude(table, 5.0, 0.015), side_view(0));
  scene.start_part("rack");
  scene.place(extrude(rack_outline(), 0.08, 0), moved({0, 0, -1.20}));
  scene.start_part("paper_fingers");
  for (double x : {-1.9, -1.72, 1.72, 1.9}) scene.place(sheet(finger_line(detail), 0.014, 0.10), side_view(x));
  scene.start_part("paper");
  scene.place(sheet(paper_line(detail), kPaperThickness, 4.4), side_view(0));
  add_paper_bail(scene, detail);
  add_return_lever(scene, detail);
}

}  // namespace facemap::generators
