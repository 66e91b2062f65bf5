#include "math/elementary.h"
#include "scene/generators/bust_figure.h"
#include "scene/generators/lathe.h"
#include "scene/generators/scene_builder.h"
#include "scene/generators/sculpt.h"

namespace facemap::generators {
namespace {

// At detail 1 the figure has 2 * 160 * 128 = 40,960 faces (160 columns, 128 rows between its poles), the socle
// 2 * 55 * 33 = 3,630 (55 points around, 33 loops): together 44,590.
constexpr int kColumns = 160, kAroundSocle = 55;

// The net's rows from crown to foot: so many of them lead to each stop.
struct Stop {
  NetRow row;
  int rows;
};

constexpr Stop kStops[] = {
    {{0.25, -0.10, 90, 90}, 0},     {{0.30, -0.10, 20, 20}, 16},                               // hair
    {{0.12, -0.10, 4, 4}, 11},                                                                 // forehead
    {{-0.12, -0.10, -1, -3}, 20},   {{-0.40, -0.10, -2, -14}, 11},                             // eyes, cheeks
    {{-0.80, -0.05, -10, -20}, 25},                                                            // nose, mouth
    {{-0.90, -0.05, -32, -20}, 8},  {{-1.02, -0.12, -36, -14}, 5},                             // chin and below
    {{-1.30, -0.26, -6, -4}, 5},    {{-1.62, -0.37, 8, 8}, 4},                                 // neck
    {{-1.95, -0.40, 14, 14}, 4},    {{-2.25, -0.40, 14, 14}, 5},   {{-2.35, -0.40, 0, 0}, 4},  // shoulders
    {{-2.35, -0.40, -50, -50}, 7},  {{-2.35, -0.40, -90, -90}, 4},                             // chest, cut
};

std::vector<NetRow> net_rows(int detail) {
  std::vector<NetRow> rows;
  for (std::size_t i = 1; i < std::size(kStops); ++i) {
    const NetRow &a = kStops[i - 1].row, &b = kStops[i].row;
    const int count = kStops[i].rows * detail;
    for (int k = 1; k <= count; ++k) {
      const double t = double(k) / count;
      rows.push_back({a.y + t * (b.y - a.y), a.z + t * (b.z - a.z), a.front_deg + t * (b.front_deg - a.front_deg),
                      a.back_deg + t * (b.back_deg - a.back_deg)});
    }
  }
  rows.pop_back();  // the lower pole
  return rows;
}

// Columns stand closer in front, on the face, than behind.
NetColumns net_columns(int count) {
  NetColumns columns;
  for (int j = 0; j < count; ++j) {
    const double a = 2 * elementary::kPi * j / count;
    columns.push_back(a - 0.5 * elementary::sin(a));
  }
  return columns;
}

// A round pedestal about the y axis; the figure stands on its top.
Solid make_socle(int detail) {
  constexpr double kFoot = -4.75, kTop = kBustCut - 0.004;
  Profile profile(0, kFoot, detail);
  profile.line(0.95, kFoot).line(0.95, kFoot + 0.18).arc(0.80, kFoot + 0.38, 0.4, 6).line(0.72, kFoot + 0.40);
  profile.curve(0.40, kFoot + 0.50, 0.42, kFoot + 0.90, 9);
  profile.line(0.47, kFoot + 0.92).arc(0.47, kFoot + 1.02, 1, 6).line(0.40, kFoot + 1.04);
  profile.curve(0.40, kTop - 0.11, 0.47, kTop, 7).line(0, kTop);
  return lathe(profile, kAroundSocle * detail);
}

}  // namespace

GeneratedScene make_bust(int detail) {
  constexpr double kAxisZ = -0.38;
  SceneBuilder scene;
  scene.start_part("figure");
  scene.place(wrap(bust_figure, net_rows(detail), net_columns(kColumns * detail)));
  scene.start_part("socle");
  scene.place(make_socle(detail), moved({0, 0, kAxisZ}));
  scene.set_camera({-3.5f, -0.1f, 9.95f}, {-0.09f, -1.84f, -0.33f}, 34);
  scene.add_light({-7, 5, 4}, {1, 0.97f, 0.92f}, 0.58f);
  scene.add_light({6, 1, 7}, {1, 0.97f, 0.92f}, 0.12f);
  scene.add_light({8, 3, -2}, {0.92f, 0.96f, 1}, 0.26f);
  scene.add_light({4, 6, -7}, {0.92f, 0.96f, 1}, 0.16f);
  scene.add_light({-4, 3, -8}, {0.92f, 0.96f, 1}, 0.12f);
  scene.add_light({-9, -1, -1}, {0.92f, 0.96f, 1}, 0.10f);
  scene.add_light({-2, -1, 10}, {1, 0.97f, 0.92f}, 0.08f);
  scene.add_light({0, 9, 4}, {1, 1, 1}, 0.22f);
  return scene.take();
}

}  // namespace facemap::generators
