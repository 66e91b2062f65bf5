#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "scene/generators/random.h"
#include "scene/generators/scene_builder.h"

namespace facemap::generators {
namespace {

constexpr double kHalfSide = 4.2;    // of the piece of turf
constexpr double kDepth = 1.1;       // of its earth
constexpr double kMargin = 0.08;     // from the turf's edge to the outermost root
constexpr double kRootDepth = 0.03;  // at detail 1: less than the first segment of a blade

// A kind of blade: `count` of them, each with 4 * segments - 2 faces.
struct BladeKind {
  int count, segments;
  double shortest, longest;
};

// At detail 1 the turf has 2 * 48^2 + 8 * 48 * 6 + 4 * 48 = 7,104 faces, the blades 800 * 34 + 1,350 * 26 + 970 * 18 =
// 79,760: together 86,864.
constexpr int kTurfCells = 48, kTurfLayers = 6;
constexpr BladeKind kBladeKinds[] = {{800, 9, 1.6, 2.5}, {1350, 7, 1.0, 1.7}, {970, 5, 0.5, 1.1}};

double ground_height(double x, double z) {
  using elementary::sin;
  return 0.16 * sin(0.9 * x + 0.4) * sin(0.8 * z + 1.1) + 0.05 * sin(2.7 * x - 1.3 * z) + 0.02 * sin(7.1 * z + 5.3 * x);
}

// Grass grows taller in some places than in others.
double growth(double x, double z) {
  using elementary::sin;
  return 0.92 + 0.16 * sin(0.8 * x + 1.9 * z) + 0.14 * sin(1.7 * x - 0.7 * z + 2);
}

// How far the earth's side stands out at distance `along` around the turf, `down` from 0 at the top to 1 below.
double side_relief(double along, double down) {
  using elementary::sin;
  const double lumps =
      sin(2.3 * along + 3 * down) + 0.6 * sin(5.9 * along - 7 * down + 1) + 0.4 * sin(11 * along + 9 * down);
  return std::min(1.0, 6 * down) * 0.06 * lumps - 0.5 * down * down;
}

// The turf: a grid on top, layers of earth around it and a flat bottom, one closed surface.
Solid make_turf(int detail) {
  const int n = kTurfCells * detail, layers = kTurfLayers * detail;
  Solid turf;
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = kHalfSide * (2.0 * i / n - 1), z = kHalfSide * (1 - 2.0 * j / n);
      turf.add_point({x, ground_height(x, z), z});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) turf.add_quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), 1);
  }
  Ring rim;
  for (int k = 0; k < n; ++k) rim.push_back(at(k, 0));
  for (int k = 0; k < n; ++k) rim.push_back(at(n, k));
  for (int k = n; k > 0; --k) rim.push_back(at(k, n));
  for (int k = n; k > 0; --k) rim.push_back(at(0, k));
  Ring above = rim;
  for (int layer = 1; layer <= layers; ++layer) {
    const double down = double(layer) / layers;
    Ring ring;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const DVector top = turf.points[rim[k]];
      const double along = 8 * kHalfSide * double(k) / double(rim.size());
      const double grow = 1 + side_relief(along, down) / kHalfSide;
      ring.push_back(turf.add_point({top.x * grow, top.y * (1 - down) - kDepth * down, top.z * grow}));
    }
    bridge(turf, ring, above, 2);
    above = ring;
  }
  cap_right(turf, above, turf.add_point({0, -kDepth, 0}), 0);
  return turf;
}

struct Blade {
  DVector root;
  double heading;  // of its bend, about the vertical
  double length, half_width;
  double lean, bend;  // angle from the vertical at the root, and what the tip adds
  double twist;
};

// A ribbon folded along its middle: three points a row, one at the tip.
void add_blade(Solid& grass, const Blade& blade, int segments) {
  const double step = blade.length / segments;
  DVector point = blade.root;
  std::uint32_t row[3] = {};
  for (int i = 0; i <= segments; ++i) {
    const double s = double(i) / segments, heading = blade.heading + blade.twist * s;
    const double tilt = blade.lean + blade.bend * s * std::sqrt(s);
    const DVector ahead(elementary::cos(blade.heading), 0, elementary::sin(blade.heading));
    const DVector across(-elementary::sin(heading), 0, elementary::cos(heading));
    const DVector back = ahead * elementary::cos(tilt) - DVector(0, elementary::sin(tilt), 0);
    if (i == segments) {
      const std::uint32_t tip = grass.add_point(point);
      grass.add_triangle(row[0], row[1], tip, 1);
      grass.add_triangle(row[1], row[2], tip, 1);
      return;
    }
    const double w = blade.half_width * (0.65 + 1.5 * s) * (1 - s) * (1 + s * 0.4);
    std::uint32_t next[3];
    next[0] = grass.add_point(point - across * w);
    next[1] = grass.add_point(point - back * (0.45 * w));
    next[2] = grass.add_point(point + across * w);
    if (i > 0) {
      grass.add_quad(row[0], row[1], next[1], next[0], 1);
      grass.add_quad(row[1], row[2], next[2], next[1], 1);
    }
    for (int k = 0; k < 3; ++k) row[k] = next[k];
    const double middle = blade.lean + blade.bend * ((i + 0.5) / segments) * std::sqrt((i + 0.5) / segments);
    point += step * (ahead * elementary::sin(middle) + DVector(0, elementary::cos(middle), 0));
  }
}

Solid make_blades(int detail) {
  // Roots follow the two-dimensional golden ratio sequence: even, without a visible grid.
  constexpr double kGolden = 1.32471795724474602596;
  constexpr double kStepX = 1 / kGolden, kStepZ = 1 / (kGolden * kGolden);
  Random random(2022);
  Solid grass;
  int placed_so_far = 0;
  for (const BladeKind& kind : kBladeKinds) {
    for (int k = 0; k < kind.count * detail; ++k) {
      ++placed_so_far;
      const double u = placed_so_far * kStepX, v = placed_so_far * kStepZ, margin = kHalfSide - kMargin;
      const double x = margin * (2 * (u - std::floor(u)) - 1), z = margin * (2 * (v - std::floor(v)) - 1);
      Blade blade;
      blade.root = {x, ground_height(x, z) - kRootDepth / detail, z};
      blade.length = random.between(kind.shortest, kind.longest) * growth(x, z);
      blade.half_width = random.between(0.035, 0.06) * (0.7 + 0.25 * blade.length) / std::sqrt(double(detail));
      // Most bend with the wind, towards +x.
      blade.heading = random.between(-2.0, 2.0) + random.between(-1.2, 1.2);
      blade.lean = random.between(0.0, 0.35);
      blade.bend = random.between(0.3, 1.5);
      blade.twist = random.between(-0.7, 0.7);
      add_blade(grass, blade, kind.segments * detail);
    }
  }
  return grass;
}

}  // namespace

GeneratedScene make_grass(int detail) {
  SceneBuilder scene;
  scene.start_part("turf");
  scene.place(make_turf(detail));
  scene.start_part("blades");
  scene.place(make_blades(detail));
  scene.set_camera({-6.3f, 6.9f, 13.4f}, {0.35f, -0.41f, 0.41f}, 46);
  scene.add_light({-8, 9, 5}, {1, 0.97f, 0.92f}, 0.64f);
  scene.add_light({7, 6, 8}, {1, 0.97f, 0.92f}, 0.21f);
  scene.add_light({10, 6, -2}, {0.92f, 0.96f, 1}, 0.10f);
  scene.add_light({5, 8, -9}, {0.92f, 0.96f, 1}, 0.16f);
  scene.add_light({-4, 6, -10}, {0.92f, 0.96f, 1}, 0.10f);
  scene.add_light({-11, 5, -4}, {0.92f, 0.96f, 1}, 0.09f);
  scene.add_light({-1, 3, 13}, {1, 0.97f, 0.92f}, 0.12f);
  scene.add_light({1, 14, 1}, {1, 1, 1}, 0.10f);
  return scene.take();
}

}  // namespace facemap::generators
