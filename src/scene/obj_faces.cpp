#include "scene/obj_faces.h"

#include <numeric>

#include "scene/reserve_pages.h"

namespace facemap {

namespace {

constexpr Corners kNoCorners = {kNoIndex, kNoIndex, kNoIndex};

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
  add_polygon_ids(added);
  if (corners.size() == 3) return;

  const auto position = [&](std::size_t i) -> const Vector& { return mesh_.positions[corners[i].vertex]; };
  if (!is_complete) {
    waiting_.push_back({first, corners.size(), line});
  } else if (corners.size() > 4 || !is_strictly_convex(position(0), position(1), position(2), position(3))) {
    cut(first, corners.size(), line);
  }
}

void ObjFaces::set(std::vector<SmoothingRun>& runs, std::uint32_t value, std::size_t first, std::uint32_t absent) {
  if (!runs.empty() && runs.back().first_triangle == first) runs.pop_back();
  const std::uint32_t current = runs.empty() ? absent : runs.back().group;
  if (value != current) runs.push_back({first, value});
}

void ObjFaces::add_polygon_ids(std::size_t triangle_count) {
  std::vector<std::uint32_t>& polygons = mesh_.polygons;
  if (!has_polygon_ids_ && triangle_count != 1) {
    reserve_pages(polygons, mesh_.triangles.capacity());
    polygons.resize(polygon_count_);
    std::iota(polygons.begin(), polygons.end(), 0u);
    has_polygon_ids_ = true;
  }
  if (has_polygon_ids_) {
    for (std::size_t i = 0; i < triangle_count; ++i) polygons.push_back(polygon_count_);
  }
  ++polygon_count_;
}

void ObjFaces::count_triangles(std::size_t count) {
  if (!has_polygon_ids_) {
    polygon_count_ += static_cast<std::uint32_t>(count);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) mesh_.polygons.push_back(polygon_count_++);
}

void ObjFaces::finish() {
  for (const Fan& fan : waiting_) cut(fan.first_triangle, fan.corner_count, fan.line);
  waiting_.clear();
  fill_materials();
}

void ObjFaces::fill_materials() {
  if (material_runs_.empty()) return;
  std::vector<std::uint32_t>& materials = mesh_.triangle_materials;
  reserve_pages(materials, mesh_.triangles.size());
  std::uint32_t material = kNoIndex;
  for (const SmoothingRun& run : material_runs_) {
    materials.resize(run.first_triangle, material);
    material = run.group;
  }
  materials.resize(mesh_.triangles.size(), material);
  material_runs_ = {};
}

void ObjFaces::cut(std::size_t first_triangle, std::size_t corner_count, std::int64_t line) {
  const Fan fan{first_triangle, corner_count, line};
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
