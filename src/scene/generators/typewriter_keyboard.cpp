#include "math/elementary.h"
#include "scene/generators/lathe.h"
#include "scene/generators/typewriter_parts.h"

namespace facemap::generators {
namespace {

constexpr int kRowCount = 4, kKeysInRow = 11;
constexpr int kAroundCap = 46, kAroundLever = 12;  // points
constexpr double kPitch = 0.60;                    // from key to key
constexpr double kRowDepth = 0.60;                 // from row to row
constexpr double kRowRise = 0.25;
constexpr double kLeverHeight = 0.62;  // of the levers that run back below the machine
constexpr double kGap = 0.004;         // between parts that touch

DVector key_place(int row, double column) {
  const double x = (column - (kKeysInRow - 1) / 2.0) * kPitch + (row - 1.5) * kPitch / 4;
  return {x, 1.05 + row * kRowRise, 3.32 - row * kRowDepth};
}

// A round cap with a metal ring and a hollow top.
Solid make_cap(int segments, int detail) {
  Profile cap(0, 0, detail);
  cap.line(0.10, 0).curve(0.16, 0, 0.18, 0.04, 4).line(0.235, 0.05);
  cap.arc(0.235, 0.125, 0.9, 8).line(0.212, 0.130).line(0.205, 0.112).curve(0.11, 0.085, 0, 0.085, 8);
  return lathe(cap, segments);
}

// The stem below a cap, bent into a lever that runs back: a round bar.
Solid make_lever(const DVector& key, int sides, int detail) {
  constexpr double kBend = 0.22, kRadius = 0.036, kEnd = 0.25;
  const double bottom = kLeverHeight + kBend;
  std::vector<DVector> path{{key.x, key.y - kGap, key.z}, {key.x, bottom, key.z}};
  const int n = 5 * detail;
  for (int k = 1; k <= n; ++k) {
    const double angle = elementary::kPi / 2 * k / n;
    const double ahead = kBend * (1 - elementary::cos(angle)), down = kBend * elementary::sin(angle);
    path.push_back({key.x, bottom - down, key.z - ahead});
  }
  path.push_back({key.x, kLeverHeight, kEnd});
  return bar(path, std::vector<double>(path.size(), kRadius), sides);
}

// A flat key with rounded corners, for the space bar and the shifts; its top is cut at the edges.
Solid make_flat_key(double width, double depth, double height, int detail) {
  const glm::dvec2 half(width / 2, depth / 2);
  return extrude(rounded_rectangle(-half, half, depth * 0.42, 6 * detail), height, height * 0.3);
}

void add_space_bar(SceneBuilder& scene, int detail) {
  const DVector middle(0, 0.92, 3.80);
  scene.start_part("space_bar");
  scene.place(make_flat_key(4.4, 0.30, 0.12, detail), composed(moved({0, 0, middle.z}), plan_view(middle.y)));
  for (double x : {-1.65, 1.65}) {  // between the levers of the keys
    scene.place(make_lever({x, middle.y - 0.06, middle.z}, kAroundLever * detail, detail));
  }
}

}  // namespace

void add_keyboard(SceneBuilder& scene, int detail) {
  const Solid cap = make_cap(kAroundCap * detail, detail);
  for (int row = 0; row < kRowCount; ++row) {
    scene.start_part("keys_row_" + std::to_string(row + 1));
    for (int column = 0; column < kKeysInRow; ++column) {
      const DVector place = key_place(row, column);
      const bool shift = row == 0 && (column == 0 || column == kKeysInRow - 1);
      if (shift) {
        scene.place(make_flat_key(0.62, 0.40, 0.12, detail),
                    composed(moved({place.x, 0, place.z}), plan_view(place.y + 0.06)));
      } else {
        scene.place(cap, moved(place));
      }
      scene.place(make_lever(place, kAroundLever * detail, detail));
    }
  }
  add_space_bar(scene, detail);
}

}  // namespace facemap::generators
