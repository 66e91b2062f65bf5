#pragma once

#include <facemap/mesh.h>

#include <cstdint>
#include <span>
#include <vector>

#include "scene/obj_warnings.h"
#include "scene/polygon.h"
#include "scene/smooth_normals.h"

namespace facemap {

/// A corner of a face statement; indices count from 0.
struct ObjCorner {
  std::uint32_t vertex = kNoIndex;
  std::uint32_t texture = kNoIndex;
  std::uint32_t normal = kNoIndex;
};

/// Turns face statements into a mesh's flat arrays. Those beside the triangles stay empty while there is nothing
/// to say in them.
class ObjFaces {
 public:
  ObjFaces(Mesh& mesh, ObjWarnings& warnings) : mesh_(mesh), warnings_(warnings) {}

  /// For the triangles from `first` on; calls ascend. kNoIndex is no material, 0 no smoothing group.
  void set_material(std::uint32_t material, std::size_t first) { set(material_runs_, material, first, kNoIndex); }
  void set_smoothing_group(std::uint32_t group, std::size_t first) { set(smoothing_runs_, group, first, 0); }

  /// Adds a face of 3 corners or more. `is_complete`: all its positions have been read; otherwise it is cut
  /// into triangles by finish().
  void add(std::span<const ObjCorner> corners, std::int64_t line, bool is_complete);

  /// Counts a face that makes no triangle.
  void leave_out() { add_polygon_ids(0); }

  /// Counts triangles that others have put at the end of Mesh::triangles; no corner has anything beside its vertex.
  void count_triangles(std::size_t count);

  /// Cuts a polygon that stands in the mesh as a fan into the right triangles. Its indices must be in range.
  void cut(std::size_t first_triangle, std::size_t corner_count, std::int64_t line);

  /// Cuts the polygons that had to wait, and fills Mesh::triangle_materials. All indices must be in range by now.
  void finish();

  std::int64_t self_intersecting() const { return self_intersecting_; }

  const std::vector<SmoothingRun>& smoothing_runs() const { return smoothing_runs_; }

 private:
  /// A polygon that stands in the mesh as a fan.
  struct Fan {
    std::size_t first_triangle;
    std::size_t corner_count;
    std::int64_t line;
  };

  static void set(std::vector<SmoothingRun>& runs, std::uint32_t value, std::size_t first, std::uint32_t absent);
  void add_polygon_ids(std::size_t triangle_count);
  void fill_materials();
  void replace_fan(const Fan& fan, std::vector<Corners>& triangles);

  Mesh& mesh_;
  ObjWarnings& warnings_;
  std::uint32_t polygon_count_ = 0;
  bool has_polygon_ids_ = false;  ///< Mesh::polygons has one a triangle
  std::int64_t self_intersecting_ = 0;
  std::vector<SmoothingRun> smoothing_runs_;
  std::vector<SmoothingRun> material_runs_;  ///< materials in the place of groups
  std::vector<Fan> waiting_;
  PolygonCutter cutter_;
  std::vector<Vector> positions_;       ///< of the polygon being cut
  std::vector<std::uint32_t> indices_;  ///< the same
};

}  // namespace facemap
