#include "scene/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace facemap {

namespace {

int largest_component(const DVector& v) {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  return 2 - (std::max(x, y) > z) * (1 + (x > y));  // without branches, which would often be foretold wrongly
}

/// A corner without its coordinate `dropped`.
PlanePoint projected(const Vector& corner, int dropped) {
  return {corner[dropped == 0 ? 1 : 0], corner[dropped == 2 ? 1 : 2]};
}

/// The coordinate to drop: the one along which the polygon's plane is steepest. Areas by Newell's sum; where they
/// vanish in rounding (a figure of eight), the sum of their parts' magnitudes tells.
int dropped_coordinate(std::span<const Vector> corners) {
  DVector area(0), magnitude(0);
  const DVector origin(corners[0]);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const DVector a = DVector(corners[i - 1]) - origin, b = DVector(corners[i]) - origin;
    const DVector left(a.y * b.z, a.z * b.x, a.x * b.y), right(a.z * b.y, a.x * b.z, a.y * b.x);
    for (int k = 0; k < 3; ++k) {
      area[k] += left[k] - right[k];
      magnitude[k] += std::abs(left[k]) + std::abs(right[k]);
    }
  }
  const double rounding = 2 * (static_cast<double>(corners.size()) + 4) * 0x1p-53;
  const int k = largest_component(area);
  return std::abs(area[k]) > rounding * magnitude[k] ? k : largest_component(magnitude);
}

using Components = std::array<double, 3>;

Components difference(const Vector& a, const Vector& b) {
  return {static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y, static_cast<double>(a.z) - b.z};
}

Components cross(const Components& a, const Components& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_strictly_convex(PlanePoint a, PlanePoint b, PlanePoint c, PlanePoint d) {
  const int turn = orientation(a, b, c);
  return turn != 0 && orientation(b, c, d) == turn && orientation(c, d, a) == turn && orientation(d, a, b) == turn;
}

/// Whether the inner parts of two edges cross in one point.
bool cross(PlanePoint a, PlanePoint b, PlanePoint c, PlanePoint d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

}  // namespace

bool is_strictly_convex(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const Components u = difference(b, a), v = difference(c, a), w = difference(d, a);
  const Components abc = cross(u, v), acd = cross(v, w);
  const int dropped = largest_component({abc[0] + acd[0], abc[1] + acd[1], abc[2] + acd[2]});

  // Twice the areas of the triangles at the four corners, in the plane of the other two coordinates.
  const int i = dropped == 2 ? 0 : dropped + 1, j = dropped == 0 ? 2 : dropped - 1;
  const double at_b = abc[dropped], at_d = acd[dropped];
  const double at_a = u[i] * w[j] - u[j] * w[i];
  const double at_c = at_b + at_d - at_a;
  // 3 roundings a product and 3 for the sums, and 2 for the bound itself.
  const double bound = 8 * 0x1p-53 * (std::abs(u[i]) + std::abs(v[i]) + std::abs(w[i])) *
                       (std::abs(u[j]) + std::abs(v[j]) + std::abs(w[j]));
  const bool all_left = std::min({at_a, at_b, at_c, at_d}) > bound;
  const bool all_right = std::max({at_a, at_b, at_c, at_d}) < -bound;
  if (all_left | all_right) return true;  // one branch: which of them holds, nothing foretells
  return is_strictly_convex(projected(a, dropped), projected(b, dropped), projected(c, dropped), projected(d, dropped));
}

PolygonCutter::Result PolygonCutter::cut(std::span<const Vector> corners) {
  // Ears of a polygon of n corners take n^2 tests at worst where the polygon is plain, n^3 where it is hostile.
  constexpr std::int64_t kWorkPerCorner = 1024;
  work_left_ = kWorkPerCorner * static_cast<std::int64_t>(corners.size());
  project(corners);
  if (is_strictly_convex()) return Result::Fan;
  if (crosses_itself()) return Result::SelfIntersecting;
  const Result result = clip_ears();
  return work_left_ > 0 ? result : Result::TooIntricate;
}

void PolygonCutter::project(std::span<const Vector> corners) {
  const int dropped = dropped_coordinate(corners);
  points_.clear();
  for (const Vector& corner : corners) points_.push_back(projected(corner, dropped));

  const auto [left, right] =
      std::minmax_element(points_.begin(), points_.end(), [](auto a, auto b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(points_.begin(), points_.end(), [](auto a, auto b) { return a.y < b.y; });
  if (static_cast<double>(high->y) - low->y > static_cast<double>(right->x) - left->x) {
    for (PlanePoint& point : points_) std::swap(point.x, point.y);
  }
  if (orientation(points_) < 0) {
    for (PlanePoint& point : points_) point.y = -point.y;
  }
}

/// All corners turn left, and the polygon goes right and back left but once (a pentagram does so twice).
bool PolygonCutter::is_strictly_convex() const {
  const std::size_t n = points_.size();
  const auto goes_right = [&](std::size_t i) {
    const PlanePoint a = points_[i], b = points_[(i + 1) % n];
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  };
  int reversals = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (orientation(points_[i], points_[(i + 1) % n], points_[(i + 2) % n]) <= 0) return false;
    reversals += goes_right(i) != goes_right((i + 1) % n);
  }
  return reversals == 2;
}

bool PolygonCutter::crosses_itself() {
  const auto n = static_cast<std::uint32_t>(points_.size());
  const auto end_of = [n](std::uint32_t edge) { return edge + 1 == n ? 0 : edge + 1; };
  const auto left_of = [&](std::uint32_t edge) { return std::min(points_[edge].x, points_[end_of(edge)].x); };
  order_.clear();
  for (std::uint32_t edge = 0; edge < n; ++edge) order_.push_back(edge);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return left_of(a) != left_of(b) ? left_of(a) < left_of(b) : a < b;
  });

  for (std::uint32_t i = 0; i < n; ++i) {
    const PlanePoint a = points_[order_[i]], b = points_[end_of(order_[i])];
    for (std::uint32_t j = i + 1; j < n && left_of(order_[j]) <= std::max(a.x, b.x); ++j) {
      if (--work_left_ <= 0) return false;
      if (cross(a, b, points_[order_[j]], points_[end_of(order_[j])])) return true;
    }
  }
  return false;
}

PolygonCutter::Result PolygonCutter::clip_ears() {
  left_ = static_cast<std::uint32_t>(points_.size());
  next_.resize(left_);
  previous_.resize(left_);
  for (std::uint32_t i = 0; i < left_; ++i) {
    next_[i] = i + 1 == left_ ? 0 : i + 1;
    previous_[i] = i == 0 ? left_ - 1 : i - 1;
  }
  triangles_.clear();
  at_ = 0;
  for (std::size_t corner = 0; corner < points_.size(); ++corner, at_ = next_[at_]) clip_spikes();
  find_blockers();
  while (left_ > 3) {
    if (!clip_some_ear() && !clip_some_flat_corner()) return Result::SelfIntersecting;  // or out of work
    clip_spikes();
  }
  if (turn_at(at_) < 0) return Result::SelfIntersecting;
  triangles_.push_back({previous_[at_], at_, next_[at_]});
  return Result::Cut;
}

/// Clips corners at which the outline turns back on itself or stands still, at_ and the next, and those that come to
/// light by it. They hold no area, and left where they are would make ears outside the polygon.
void PolygonCutter::clip_spikes() {
  while (left_ > 3) {
    if (is_spike(at_)) {
      clip(at_);
    } else if (is_spike(next_[at_])) {
      clip(next_[at_]);
    } else {
      return;
    }
  }
}

bool PolygonCutter::is_spike(std::uint32_t corner) const {
  if (turn_at(corner) != 0) return false;
  const PlanePoint a = points_[previous_[corner]], b = points_[corner], c = points_[next_[corner]];
  const bool goes_on = a.x != c.x ? std::min(a.x, c.x) < b.x && b.x < std::max(a.x, c.x)
                                  : std::min(a.y, c.y) < b.y && b.y < std::max(a.y, c.y);
  return !goes_on;
}

/// If any corner lies in an ear, one that does not turn left does; and clipping makes no new ones of these.
void PolygonCutter::find_blockers() {
  order_.clear();
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (next_[i] != kNoIndex && turn_at(i) <= 0) order_.push_back(i);
  }
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points_[a].x != points_[b].x ? points_[a].x < points_[b].x : a < b;
  });
}

bool PolygonCutter::clip_some_ear() {
  for (std::uint32_t tried = 0; tried < left_; ++tried, at_ = next_[at_]) {
    if (--work_left_ <= 0) return false;
    if (is_ear(at_)) {
      clip(at_);
      return true;
    }
  }
  return false;
}

bool PolygonCutter::clip_some_flat_corner() {
  for (std::uint32_t tried = 0; tried < left_; ++tried, at_ = next_[at_]) {
    if (--work_left_ <= 0) return false;
    if (turn_at(at_) == 0) {
      clip(at_);
      return true;
    }
  }
  return false;
}

bool PolygonCutter::is_ear(std::uint32_t corner) {
  if (turn_at(corner) <= 0) return false;
  const float a = points_[previous_[corner]].x, b = points_[corner].x, c = points_[next_[corner]].x;
  const float left = std::min({a, b, c}), right = std::max({a, b, c});
  auto blocker =
      std::lower_bound(order_.begin(), order_.end(), left, [&](std::uint32_t i, float x) { return points_[i].x < x; });
  for (; blocker != order_.end() && points_[*blocker].x <= right; ++blocker) {
    if (--work_left_ <= 0) return false;
    if (blocks(*blocker, corner)) return false;
  }
  return true;
}

/// Whether a corner that is left lies in the closed triangle about `corner`. One that coincides with a corner of
/// the triangle blocks only if the outline goes from there into the triangle.
bool PolygonCutter::blocks(std::uint32_t blocker, std::uint32_t corner) const {
  const std::uint32_t before = previous_[corner], after = next_[corner];
  if (next_[blocker] == kNoIndex || blocker == before || blocker == corner || blocker == after) return false;
  const PlanePoint a = points_[before], b = points_[corner], c = points_[after], p = points_[blocker];
  if (p == a || p == c) return false;
  if (p == b) {
    const auto goes_inside = [&](PlanePoint q) { return orientation(a, b, q) > 0 && orientation(b, c, q) > 0; };
    return goes_inside(points_[next_[blocker]]) || goes_inside(points_[previous_[blocker]]);
  }
  return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
}

int PolygonCutter::turn_at(std::uint32_t corner) const {
  return orientation(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

void PolygonCutter::clip(std::uint32_t corner) {
  const std::uint32_t before = previous_[corner], after = next_[corner];
  triangles_.push_back({before, corner, after});
  next_[before] = after;
  previous_[after] = before;
  next_[corner] = kNoIndex;
  --left_;
  at_ = before;  // both neighbours come next: they have changed
}

}  // namespace facemap
