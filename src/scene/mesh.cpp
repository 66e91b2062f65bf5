#include <facemap/mesh.h>

namespace facemap {

Face Mesh::face(std::size_t face) const {
  Face result;
  for (int corner = 0; corner < 3; ++corner) {
    result.vertices[corner] = vertex(face, corner);
    if (normal_corners.empty()) continue;
    const std::uint32_t normal = normal_corners[face][corner];
    if (normal != kNoIndex) result.normals[corner] = normals[normal];
  }
  return result;
}

}  // namespace facemap
