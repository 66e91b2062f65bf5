#pragma once

#include <facemap/mesh.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

/// The bounds of the vertices of some faces of a mesh, or of all its positions if there are no such faces. The mesh
/// and the faces must outlive it.
class VertexBounds {
 public:
  VertexBounds(const Mesh& mesh, const std::vector<std::uint32_t>& faces, const Executor& executor);

  /// The lower and the upper corner of the box; a zero is the one that comes first by faces and corners, 0 or -0.
  std::pair<Vector, Vector> box() const;

  /// The square of the distance of the vertex that is farthest from `centre`.
  double farthest_squared(const DVector& centre) const;

 private:
  template <class Visit>
  void for_each_vertex(std::size_t first, std::size_t last, const Visit& visit) const;
  float first_zero(int axis) const;

  const Mesh& mesh_;
  const std::vector<std::uint32_t>& faces_;
  const Executor& executor_;
  std::vector<std::uint8_t> used_;  ///< one a position
};

}  // namespace facemap
