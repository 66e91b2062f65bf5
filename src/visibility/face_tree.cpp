#include "visibility/face_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "map/face_planes.h"
#include "math/dvector.h"

namespace facemap {
namespace {

// Of places: they are rounded to floats, those of faces and those of rays, at most 1 + 2^-20 in size.
constexpr double kPlaceMargin = 0x1p-22;

// Relative, of the difference of two coordinates that were rounded in double themselves.
constexpr double kDifferenceError = 0x1p-50;

constexpr float kNone = std::numeric_limits<float>::infinity();

// Spreads sixteen bits two apart.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

// Along a curve that passes all places of a small square before the next: Morton 1966.
std::uint32_t place_on_curve(float u, float v) {
  const auto cell = [](float x) { return static_cast<std::uint32_t>(std::clamp((x + 1) * 32768, 0.0f, 65535.0f)); };
  return spread(cell(u)) | spread(cell(v)) << 1;
}

// Of the part of an interval that is on a side.
float middle_of(float low, float high) { return 0.5f * (std::max(low, -1.0f) + std::min(high, 1.0f)); }

// Depth along the side's axis, and the two coordinates across.
DVector seen_on(int side, const DVector& x) {
  const int k = side / 2;
  return {x[(k + 1) % 3], x[(k + 2) % 3], side % 2 == 0 ? x[k] : -x[k]};
}

int side_of(const Vector& direction) {
  int k = 0;
  if (std::fabs(direction.y) > std::fabs(direction[k])) k = 1;
  if (std::fabs(direction.z) > std::fabs(direction[k])) k = 2;
  return 2 * k + (direction[k] < 0 ? 1 : 0);
}

// Whether all corners are beyond one of the four planes that bound the side: then so is the face.
bool is_beside(const std::array<DVector, 3>& corners) {
  for (int k = 0; k < 2; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const bool all = std::all_of(corners.begin(), corners.end(), [&](const DVector& p) {
        return sign * p[k] - p.z > kDifferenceError * (std::fabs(p[k]) + std::fabs(p.z));
      });
      if (all) return true;
    }
  }
  return false;
}

}  // namespace

FaceTree::Boxes::Boxes() {
  for (auto* low : {&u0, &v0, &near}) low->fill(kNone);
  for (auto* high : {&u1, &v1}) high->fill(-kNone);
}

void FaceTree::Boxes::set(std::size_t k, const Box& box) {
  u0[k] = box.u0;
  u1[k] = box.u1;
  v0[k] = box.v0;
  v1[k] = box.v1;
  near[k] = box.near;
}

// By itself, so that compilers take all boxes at once.
[[gnu::noinline]] std::uint32_t FaceTree::Boxes::met_by(float u, float v, float far) const {
  std::array<std::uint32_t, kTogether> is_met;
  for (std::size_t k = 0; k < kTogether; ++k) {
    const std::uint32_t across = std::uint32_t{u0[k] <= u} & std::uint32_t{u <= u1[k]};
    const std::uint32_t down = std::uint32_t{v0[k] <= v} & std::uint32_t{v <= v1[k]};
    is_met[k] = across & down & std::uint32_t{near[k] <= far};
  }
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTogether; ++k) bits |= is_met[k] << k;
  return bits;
}

FaceTree::Box FaceTree::Boxes::all() const {
  const auto least = [](const auto& values) { return *std::min_element(values.begin(), values.end()); };
  const auto most = [](const auto& values) { return *std::max_element(values.begin(), values.end()); };
  return {least(u0), most(u1), least(v0), most(v1), least(near)};
}

// A direction that meets the face has a place between those of its corners, if all are in front of the origin.
std::optional<FaceTree::Box> FaceTree::box_on(const std::array<DVector, 3>& corners) {
  const auto [least, most] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
  if (most <= 0 || is_beside(corners)) return std::nullopt;
  if (least <= 0) return Box{-2, 2, -2, 2, 0};
  std::array<double, 2> low, high;
  for (int k = 0; k < 2; ++k) {
    const std::array<double, 3> places{corners[0][k] / corners[0].z, corners[1][k] / corners[1].z,
                                       corners[2][k] / corners[2].z};
    const auto [first, last] = std::minmax_element(places.begin(), places.end());
    low[static_cast<std::size_t>(k)] = std::clamp(*first - kPlaceMargin, -2.0, 2.0);
    high[static_cast<std::size_t>(k)] = std::clamp(*last + kPlaceMargin, -2.0, 2.0);
  }
  return Box{static_cast<float>(low[0]), static_cast<float>(high[0]), static_cast<float>(low[1]),
             static_cast<float>(high[1]), float_below(least)};
}

FaceTree::FaceTree(const Scene& scene, const std::vector<std::uint32_t>& faces, const Vector& origin,
                   const Executor& executor) {
  executor.for_each(sides_.size(), [&](std::size_t side, int) {
    sides_[side] = make_side(scene, faces, origin, static_cast<int>(side));
  });
}

FaceTree::Side FaceTree::make_side(const Scene& scene, const std::vector<std::uint32_t>& faces, const Vector& origin,
                                   int number) {
  struct Entry {
    std::uint32_t place, face;
    Box box;
  };
  std::vector<Entry> entries;
  for (const std::uint32_t face : faces) {
    const Triangle f = triangle_of(scene, face);
    std::array<DVector, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = seen_on(number, DVector(f[k]) - DVector(origin));
    if (const std::optional<Box> box = box_on(corners)) {
      entries.push_back({place_on_curve(middle_of(box->u0, box->u1), middle_of(box->v0, box->v1)), face, *box});
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.place != b.place ? a.place < b.place : a.face < b.face; });

  Side side;
  std::vector<Boxes> boxes((entries.size() + kTogether - 1) / kTogether);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    boxes[i / kTogether].set(i % kTogether, entries[i].box);
    side.faces.push_back(entries[i].face);
  }
  side.levels.push_back(std::move(boxes));
  add_levels(side);
  return side;
}

void FaceTree::add_levels(Side& side) {
  while (side.levels.back().size() > 1) {
    const std::vector<Boxes>& below = side.levels.back();
    std::vector<Boxes> level((below.size() + kTogether - 1) / kTogether);
    for (std::size_t i = 0; i < below.size(); ++i) level[i / kTogether].set(i % kTogether, below[i].all());
    side.levels.push_back(std::move(level));
  }
}

std::size_t FaceTree::find(const Vector& direction, double end, std::vector<std::uint32_t>& found) const {
  found.clear();
  const int number = side_of(direction);
  const Side& side = sides_[static_cast<std::size_t>(number)];
  if (side.faces.empty()) return 0;
  const DVector d = seen_on(number, DVector(direction));
  const auto u = static_cast<float>(d.x / d.z), v = static_cast<float>(d.y / d.z);
  const double depth = end * d.z;
  const float far = depth < std::numeric_limits<float>::max() ? float_above(depth) : HUGE_VALF;
  // At most seven wait on each level while the eighth is looked into.
  std::array<std::pair<std::uint32_t, std::uint32_t>, 128> open;  // level, group
  std::size_t open_count = 0, boxes = 0;
  open[open_count++] = {static_cast<std::uint32_t>(side.levels.size() - 1), 0};
  while (open_count > 0) {
    const auto [level, group] = open[--open_count];
    for (std::uint32_t met = side.levels[level][group].met_by(u, v, far); met != 0; met &= met - 1) {
      const auto child =
          static_cast<std::uint32_t>(group * kTogether) + static_cast<std::uint32_t>(std::countr_zero(met));
      if (level == 0) {
        found.push_back(side.faces[child]);
      } else {
        open[open_count++] = {level - 1, child};
      }
    }
    boxes += kTogether;
  }
  return boxes;
}

std::vector<std::uint32_t> FaceTree::in_order(std::size_t face_count) const {
  std::vector<std::uint32_t> order;
  std::vector<bool> is_listed(face_count);
  for (const Side& side : sides_) {
    for (const std::uint32_t face : side.faces) {
      if (is_listed[face]) continue;
      is_listed[face] = true;
      order.push_back(face);
    }
  }
  return order;
}

std::size_t FaceTree::memory_bytes() const noexcept {
  std::size_t bytes = 0;
  for (const Side& side : sides_) {
    bytes += side.faces.capacity() * sizeof(std::uint32_t);
    for (const auto& level : side.levels) bytes += level.capacity() * sizeof(Boxes);
  }
  return bytes;
}

}  // namespace facemap
