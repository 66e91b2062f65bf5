#pragma once

#include <facemap/face.h>
#include <facemap/vector.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace facemap {

/// Three indices, one a corner.
using Corners = std::array<std::uint32_t, 3>;

/// "This corner, face or triangle has none."
inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

/// Triangles as flat arrays, in the file's order after triangulation. All positions are finite.
struct Mesh {
  std::vector<Vector> positions;
  std::vector<Vector> normals;  ///< need not be of unit length
  std::vector<glm::vec2> texture_coordinates;
  std::vector<Vector> colours;                    ///< one a position, RGB in 0..1, or empty
  std::vector<Corners> triangles;                 ///< into positions
  std::vector<Corners> normal_corners;            ///< one a triangle into normals (kNoIndex: none), or empty
  std::vector<Corners> texture_corners;           ///< one a triangle into texture_coordinates, or empty
  std::vector<std::uint32_t> polygons;            ///< one a triangle: the file's face; empty: face i is triangle i
  std::vector<std::uint32_t> triangle_materials;  ///< one a triangle into the materials (kNoIndex: none), or empty

  std::size_t face_count() const noexcept { return triangles.size(); }

  /// Vertex `corner` (0..2) of triangle `face`. No bounds check.
  const Vector& vertex(std::size_t face, int corner) const { return positions[triangles[face][corner]]; }

  /// The triangle as the paper's Face; corners without a normal have the zero vector.
  Face face(std::size_t face) const;
};

}  // namespace facemap
