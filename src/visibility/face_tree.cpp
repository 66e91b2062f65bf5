#include "visibility/face_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "map/face_planes.h"

namespace facemap {
namespace {

constexpr std::size_t kChildren = 4;
constexpr std::size_t kFewestFaces = 4096;  // a task
constexpr double kCells = 1024;             // a side of the scene's box

// A parameter is a difference of two floats, rounded, times an inverse, rounded, rounded itself: within 2^-51 of it.
constexpr double kSlack = 0x1p-50;

// Spreads the lower ten bits three apart.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// The place along a curve that passes all cells of a small cube before the next: Morton 1966.
std::uint32_t place_on_curve(const Scene& scene, std::uint32_t face) {
  const Triangle corners = triangle_of(scene, face);
  std::uint32_t place = 0;
  for (int k = 0; k < 3; ++k) {
    const double low = scene.lower()[k], size = scene.upper()[k] - low;
    const double middle = (double{corners[0][k]} + double{corners[1][k]} + double{corners[2][k]}) / 3;
    const double cell = size > 0 ? std::clamp((middle - low) / size * kCells, 0.0, kCells - 1) : 0.0;
    place |= spread(static_cast<std::uint32_t>(cell)) << k;
  }
  return place;
}

}  // namespace

// A ray whose coordinates are looked at one by one.
class FaceTree::Ray {
 public:
  Ray(const Vector& origin, const Vector& direction, double end) : origin_(origin), end_(end) {
    for (int k = 0; k < 3; ++k) inverse_[k] = direction[k] == 0 ? kNever : 1 / double{direction[k]};
  }

  // Nothing is shut out by an end that is not a number.
  bool may_meet(const Box& box) const {
    double begin = 0, end = end_;
    for (int k = 0; k < 3; ++k) {
      if (inverse_[k] == kNever) {
        if (box.lower[k] > origin_[k] || box.upper[k] < origin_[k]) return false;
        continue;
      }
      double first = (double{box.lower[k]} - origin_[k]) * inverse_[k];
      double last = (double{box.upper[k]} - origin_[k]) * inverse_[k];
      if (inverse_[k] < 0) std::swap(first, last);
      first -= std::fabs(first) * kSlack;
      last += std::fabs(last) * kSlack;
      if (first > begin) begin = first;
      if (last < end) end = last;
    }
    return !(begin > end);
  }

 private:
  static constexpr double kNever = 0;  // the inverse for a coordinate that does not change

  DVector origin_, inverse_{0};
  double end_;
};

FaceTree::FaceTree(const Scene& scene, std::vector<std::uint32_t> faces, const Executor& executor)
    : faces_(std::move(faces)) {
  sort(scene, executor);
  make_boxes(scene, executor);
}

void FaceTree::sort(const Scene& scene, const Executor& executor) {
  std::vector<std::uint64_t> keys(faces_.size());
  for_ranges(executor, faces_.size(), kFewestFaces, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) {
      keys[i] = std::uint64_t{place_on_curve(scene, faces_[i])} << 32 | faces_[i];
    }
  });
  std::sort(keys.begin(), keys.end());
  std::transform(keys.begin(), keys.end(), faces_.begin(),
                 [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
}

void FaceTree::make_boxes(const Scene& scene, const Executor& executor) {
  levels_.emplace_back(faces_.size());
  for_ranges(executor, faces_.size(), kFewestFaces, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) {
      const Triangle f = triangle_of(scene, faces_[i]);
      levels_[0][i] = {glm::min(glm::min(f[0], f[1]), f[2]), glm::max(glm::max(f[0], f[1]), f[2])};
    }
  });
  while (levels_.back().size() > kChildren) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> level((below.size() + kChildren - 1) / kChildren);
    for (std::size_t i = 0; i < below.size(); ++i) {
      Box& box = level[i / kChildren];
      if (i % kChildren == 0) box = below[i];
      box = {glm::min(box.lower, below[i].lower), glm::max(box.upper, below[i].upper)};
    }
    levels_.push_back(std::move(level));
  }
}

std::size_t FaceTree::find(const Vector& origin, const Vector& direction, double end,
                           std::vector<std::uint32_t>& found) const {
  found.clear();
  const Ray ray(origin, direction, end);
  // At most three wait on each level while the fourth is looked into.
  std::array<std::pair<std::uint32_t, std::uint32_t>, 128> open;  // level, first of the boxes that have one parent
  std::size_t open_count = 0, boxes = 0;
  open[open_count++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
  while (open_count > 0) {
    const auto [level, first] = open[--open_count];
    const std::vector<Box>& all = levels_[level];
    const std::size_t last = std::min<std::size_t>(first + kChildren, all.size());
    for (std::size_t i = first; i < last; ++i) {
      if (!ray.may_meet(all[i])) continue;
      if (level == 0) {
        found.push_back(faces_[i]);
      } else {
        open[open_count++] = {level - 1, static_cast<std::uint32_t>(i * kChildren)};
      }
    }
    boxes += last - first;
  }
  return boxes;
}

std::size_t FaceTree::memory_bytes() const noexcept {
  std::size_t bytes = faces_.capacity() * sizeof faces_[0];
  for (const auto& level : levels_) bytes += level.capacity() * sizeof(Box);
  return bytes;
}

}  // namespace facemap
