#pragma once

#include <facemap/mesh.h>
#include <facemap/vector.h>

#include <cstdint>
#include <span>
#include <vector>

#include "scene/polygon_orientation.h"

namespace facemap {

/// Whether a quad turns to the same side at all four corners, in its own plane: the quick way to know, for most
/// faces of most files, that its fan about a is right.
bool is_strictly_convex(const Vector& a, const Vector& b, const Vector& c, const Vector& d);

/// Cuts polygons into triangles by ear clipping (Meisters 1975, "Polygons have ears"). Signs are exact, and taken
/// in the polygon's own plane: in the two coordinates in which the polygon looks largest. Triangles of zero area
/// come out only where corners coincide or all that is left lies on one line.
class PolygonCutter {
 public:
  enum class Result {
    Fan,               ///< strictly convex: the fan (0, i - 1, i) about the first corner is right
    Cut,               ///< triangles() is right
    SelfIntersecting,  ///< nothing is right; a fan is as good as any
    TooIntricate,      ///< given up: the work would be out of proportion to the number of corners
  };

  /// Cuts the polygon with these corners (3 or more, finite; edges may touch or coincide, as those that lead to
  /// a hole do) into n - 2 triangles.
  Result cut(std::span<const Vector> corners);

  /// What the last call made if its result was Cut; corners count from 0.
  const std::vector<Corners>& triangles() const { return triangles_; }

 private:
  void project(std::span<const Vector> corners);
  bool is_strictly_convex() const;
  bool crosses_itself();
  Result clip_ears();
  void clip_spikes();
  bool is_spike(std::uint32_t corner) const;
  void find_blockers();
  bool clip_some_ear();
  bool clip_some_flat_corner();
  bool is_ear(std::uint32_t corner);
  bool blocks(std::uint32_t blocker, std::uint32_t corner) const;
  int turn_at(std::uint32_t corner) const;
  void clip(std::uint32_t corner);

  std::vector<PlanePoint> points_;   ///< counter-clockwise, wider than high
  std::vector<std::uint32_t> next_;  ///< the ring of corners that are left; kNoIndex where one is gone
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> order_;  ///< blockers of ears, or edges, by ascending x
  std::vector<Corners> triangles_;
  std::uint32_t left_ = 0;      ///< corners in the ring
  std::uint32_t at_ = 0;        ///< where the search for an ear goes on
  std::int64_t work_left_ = 0;  ///< in tests of one pair
};

}  // namespace facemap
