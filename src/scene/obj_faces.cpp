#include "scene/obj_faces.h"

#include <numeric>

#include "scene/reserve_pages.h"

namespace facemap {

namespace {

constexpr Corners kNoCorners = {kNoIndex, kNoIndex, kNoIndex};

/// Appends `value` for the last `added` triangles to an array that stays empty while all values are `absent`.
void append(std::vector<std::uint32_t>& values, const std::vector<Corners>& triangles, std::size_t added,
            std::uint32_t value, std::uint32_t absent) {
  if (values.empty()) {
    if (value == absent) return;
    reserve_pages(values, triangles.capacity());
    values.assign(triangles.size() - added, absent);
  }
  for (std::size_t i = 0; i < added; ++i) values.push_back(value);
}

/// Appends the fan of the last polygon's indices to an array that is empty up to the first polygon that has some.
template <std::uint32_t ObjCorner::*index>
void append_fan(std::vector<Corners>& values, const std::vector<Corners>& triangles,
                std::span<const ObjCorner> corners) {
  if (values.empty()) {
    reserve_pages(values, triangles.capacity());
    values.assign(triangles.size() - (corners.size() - 2), kNoCorners);
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    values.push_back({corners[0].*index, corners[i - 1].*index, corners[i].*index});
  }
}

/// Corner `i` of a polygon that stands as a fan from `first` on.
std::uint32_t fan_corner(const std::vector<Corners>& triangles, std::size_t first, std::size_t i) {
  return i < 2 ? triangles[first][i] : triangles[first + i - 2][2];
}

}  // namespace

void ObjFaces::add(std::span<const ObjCorner> corners, std::int64_t line, bool is_complete) {
  const std::size_t first = mesh_.triangles.size();
  const std::size_t added = corners.size() - 2;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh_.triangles.push_back({corners[0].vertex, corners[i - 1].vertex, corners[i].vertex});
  }
  std::uint32_t textures = kNoIndex, normals = kNoIndex;  // these as long as no corner has any
  for (const ObjCorner& corner : corners) {
    textures &= corner.texture;
    normals &= corner.normal;
  }
  if (textures != kNoIndex || !mesh_.texture_corners.empty()) {
    append_fan<&ObjCorner::texture>(mesh_.texture_corners, mesh_.triangles, corners);
  }
  if (normals != kNoIndex || !mesh_.normal_corners.empty()) {
    append_fan<&ObjCorner::normal>(mesh_.normal_corners, mesh_.triangles, corners);
  }
  append(mesh_.triangle_materials, mesh_.triangles, added, material_, kNoIndex);
  add_polygon_ids(added);
  if (corners.size() == 3) return;

  const Fan fan{first, corners.size(), line};
  const auto position = [&](std::size_t i) -> const Vector& { return mesh_.positions[corners[i].vertex]; };
  if (!is_complete) {
    waiting_.push_back(fan);
  } else if (corners.size() > 4 || !is_strictly_convex(position(0), position(1), position(2), position(3))) {
    cut(fan);
  }
}

void ObjFaces::set_smoothing_group(std::uint32_t group) {
  const std::size_t first = mesh_.triangles.size();
  if (!smoothing_runs_.empty() && smoothing_runs_.back().first_triangle == first) smoothing_runs_.pop_back();
  const std::uint32_t current = smoothing_runs_.empty() ? 0 : smoothing_runs_.back().group;
  if (group != current) smoothing_runs_.push_back({first, group});
}

void ObjFaces::add_polygon_ids(std::size_t triangle_count) {
  std::vector<std::uint32_t>& polygons = mesh_.polygons;
  if (polygons.empty() && triangle_count > 1) {
    reserve_pages(polygons, mesh_.triangles.capacity());
    polygons.resize(polygon_count_);
    std::iota(polygons.begin(), polygons.end(), 0u);
  }
  if (!polygons.empty() || triangle_count > 1) {
    for (std::size_t i = 0; i < triangle_count; ++i) polygons.push_back(polygon_count_);
  }
  ++polygon_count_;
}

void ObjFaces::finish() {
  for (const Fan& fan : waiting_) cut(fan);
  waiting_.clear();
}

void ObjFaces::cut(const Fan& fan) {
  positions_.clear();
  for (std::size_t i = 0; i < fan.corner_count; ++i) {
    positions_.push_back(mesh_.positions[fan_corner(mesh_.triangles, fan.first_triangle, i)]);
  }
  switch (cutter_.cut(positions_)) {
    case PolygonCutter::Result::Fan:
      return;
    case PolygonCutter::Result::Cut:
      break;
    case PolygonCutter::Result::SelfIntersecting:
      ++self_intersecting_;
      warnings_.add(fan.line, "polygon crosses itself, made a fan");
      return;
    case PolygonCutter::Result::TooIntricate:
      warnings_.add(fan.line, "polygon too intricate to be cut, made a fan");
      return;
  }
  replace_fan(fan, mesh_.triangles);
  if (!mesh_.texture_corners.empty()) replace_fan(fan, mesh_.texture_corners);
  if (!mesh_.normal_corners.empty()) replace_fan(fan, mesh_.normal_corners);
}

/// Replaces the triangles of a fan by those that the cutter made.
void ObjFaces::replace_fan(const Fan& fan, std::vector<Corners>& triangles) {
  indices_.clear();
  for (std::size_t i = 0; i < fan.corner_count; ++i) {
    indices_.push_back(fan_corner(triangles, fan.first_triangle, i));
  }
  for (std::size_t i = 0; i + 2 < fan.corner_count; ++i) {
    const Corners& cut = cutter_.triangles()[i];
    triangles[fan.first_triangle + i] = {indices_[cut[0]], indices_[cut[1]], indices_[cut[2]]};
  }
}

}  // namespace facemap
