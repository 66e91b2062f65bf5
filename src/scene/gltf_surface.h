#pragma once

#include <facemap/mesh.h>

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "scene/gltf_accessor.h"

namespace facemap {

/// The triangles of one primitive of a glTF mesh, with those vertices that they use, in the mesh's own coordinates.
struct GltfSurface {
  /// What a vertex hangs on: numbers of a skin's joints, each with its weight.
  struct Joints {
    std::array<std::uint16_t, 4> joints;
    std::array<float, 4> weights;
  };

  std::vector<DVector> positions;  ///< finite
  // One a position, or none:
  std::vector<Vector> normals;
  std::vector<glm::vec2> texture_coordinates;
  std::vector<Vector> colours;
  std::vector<Joints> joints;

  std::vector<Corners> triangles;
  std::uint32_t material = kNoIndex;
};

/// Reads primitives. Primitives of a mesh often share one long list of vertices and use a part each.
class GltfSurfaces {
 public:
  GltfSurfaces(const GltfFile& file, GltfAccessors& accessors, const std::vector<std::uint32_t>& coordinate_sets)
      : file_(file), accessors_(accessors), coordinate_sets_(coordinate_sets) {}

  /// A surface without triangles if the primitive has none (points, lines), with a warning.
  GltfSurface read(const GltfValue& primitive);

 private:
  void check_count(const GltfValue& primitive, std::uint64_t triangles) const;
  std::vector<std::uint32_t> read_corners(const GltfValue& primitive, std::uint32_t vertex_count);
  std::vector<std::uint32_t> number_anew(std::vector<std::uint32_t>& corners, std::uint32_t vertex_count);
  void read_attributes(const GltfValue& attributes, const std::vector<std::uint32_t>& vertices, GltfSurface& surface);
  void read_joints(const GltfValue& attributes, const std::vector<std::uint32_t>& vertices, std::uint32_t vertex_count,
                   GltfSurface& surface);
  const GltfAccessor* open(const GltfValue& attributes, std::string_view name, std::uint32_t vertex_count,
                           int least_components, int most_components);
  std::uint32_t coordinate_set(std::uint32_t material) const;

  const GltfFile& file_;
  GltfAccessors& accessors_;
  const std::vector<std::uint32_t>& coordinate_sets_;
  std::vector<std::uint32_t> new_numbers_;  ///< of vertices; kNoIndex between two calls
};

}  // namespace facemap
