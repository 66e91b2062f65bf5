#pragma once

#include <facemap/material.h>
#include <facemap/mesh.h>
#include <facemap/model.h>

#include <cstdint>
#include <vector>

#include "scene/colour_materials.h"
#include "scene/colour_values.h"
#include "scene/obj_faces.h"
#include "scene/obj_warnings.h"
#include "scene/ply_body.h"

namespace facemap {

/// Turns rows of indices, polygons and strips of triangles, into triangles of `model`.
class PlyFaces {
 public:
  /// `vertex_count` is what the head says: faces may come before vertices.
  PlyFaces(Model& model, std::uint64_t vertex_count, const ModelLimits& limits, ObjWarnings& warnings)
      : model_(model),
        vertex_count_(static_cast<std::int64_t>(vertex_count)),
        limits_(limits),
        warnings_(warnings),
        faces_(model.mesh, warnings),
        colours_(model.materials) {}

  /// Whether an element has the indices that make it one of faces or strips.
  static bool has_indices(const PlyElement& element);

  /// Element "face": a polygon a row. The first `texture_count` materials are those of textures.
  void read_polygons(PlyBody& body, const PlyElement& element, std::uint32_t texture_count);

  /// Element "tristrips": strips of triangles, with -1 between them.
  void read_strips(PlyBody& body, const PlyElement& element, std::uint32_t texture_count);

  /// Cuts polygons; all vertices have been read.
  void finish() { faces_.finish(); }

 private:
  void plan(PlyBody& body, const PlyElement& element, std::uint32_t texture_count);
  std::uint64_t add_triangles(PlyBody& body, const PlyElement& element, std::uint64_t rows);
  void add_polygon(PlyBody& body, const PlyElement& element, std::uint64_t number);
  void add_strip(PlyBody& body, const PlyElement& element, std::uint64_t number);
  std::uint32_t vertex(PlyBody& body, const PlyElement& element, std::uint64_t number, std::int64_t index) const;
  void check_room(PlyBody& body, std::size_t triangles) const;
  void add_texture_coordinates(PlyBody& body);
  std::uint32_t material_of_row();

  Model& model_;
  std::int64_t vertex_count_;
  ModelLimits limits_;
  ObjWarnings& warnings_;
  ObjFaces faces_;
  ColourMaterials colours_;
  PlyFaceRow row_;
  std::array<ColourScale, 3> scales_{};
  bool has_colours_ = false;
  std::uint32_t texture_count_ = 0;
  std::vector<ObjCorner> corners_;  ///< of the row
};

}  // namespace facemap
