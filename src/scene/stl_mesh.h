#pragma once

#include <facemap/mesh.h>
#include <facemap/model.h>

#include <cstdint>
#include <string>
#include <vector>

#include "scene/obj_warnings.h"

namespace facemap {

/// Gathers the facets of an STL file: three vertices each, which are welded in the end.
class StlMesh {
 public:
  static constexpr std::uint64_t kMostFacets = (kNoIndex - 1) / 3;  ///< three positions each, numbered in 32 bits

  explicit StlMesh(Model& model) : model_(model) {}

  void reserve(std::size_t facets);

  std::uint64_t facet_count() const { return model_.mesh.positions.size() / 3; }

  /// `corners` are three, finite; `normal` is the one that the file states, of any length, or zero.
  void add(const Vector* corners, const Vector& normal);

  /// Welds vertices of the same value (-0 is 0) and makes triangles. Vertices are in order of first sight. `threads`
  /// may work on many (0: as many as the process may run at once).
  void finish(int threads, ObjWarnings& warnings);

 private:
  void weld_vertices(int threads);

  Model& model_;
  std::int64_t along_ = 0, opposite_ = 0;  ///< facets whose normal agrees with their winding, or does not
};

/// Both readers' names for what read_stl reads; the facets of a text have a name a solid.
void read_stl_text(std::string_view text, const std::string& name, const ModelLimits& limits, StlMesh& mesh,
                   Model& model, ObjWarnings& warnings);
void read_stl_binary(std::string_view bytes, const std::string& name, const ModelLimits& limits, StlMesh& mesh,
                     Model& model, ObjWarnings& warnings);

}  // namespace facemap
