#include "scene/stl_mesh.h"

#include "parallel/executor.h"
#include "scene/odd_faces.h"
#include "scene/reserve_pages.h"

namespace facemap {

namespace {

constexpr std::uint64_t kFewFacets = 1 << 15;  ///< below which threads cost more than they gain

/// Whether the normal of a counter-clockwise triangle points the same way as `normal` (+1), the opposite way (-1), or
/// neither (0: also if anything is not a number).
int agreement(const Vector* corners, const Vector& normal) {
  const DVector u = DVector(corners[1]) - DVector(corners[0]), v = DVector(corners[2]) - DVector(corners[0]);
  const double dot = (u.y * v.z - u.z * v.y) * double(normal.x) + (u.z * v.x - u.x * v.z) * double(normal.y) +
                     (u.x * v.y - u.y * v.x) * double(normal.z);
  return (dot > 0) - (dot < 0);
}

}  // namespace

void StlMesh::reserve(std::size_t facets) { reserve_pages(model_.mesh.positions, 3 * facets); }

void StlMesh::add(const Vector* corners, const Vector& normal) {
  model_.mesh.positions.insert(model_.mesh.positions.end(), corners, corners + 3);
  const int sign = agreement(corners, normal);
  along_ += sign > 0;
  opposite_ += sign < 0;
}

void StlMesh::finish(int threads, ObjWarnings& warnings) {
  if (opposite_ > along_) {
    warnings.add(0, "normals say the opposite of the winding, which counts",
                 std::to_string(opposite_) + " of " + std::to_string(facet_count()) + " facets");
  }
  weld_vertices(threads);
}

void StlMesh::weld_vertices(int threads) {
  Mesh& mesh = model_.mesh;
  const std::vector<std::uint32_t> first_of_value =
      weld(mesh.positions, Executor(facet_count() < kFewFacets ? 1 : threads));
  reserve_pages(mesh.triangles, facet_count());
  std::vector<std::uint32_t> index(mesh.positions.size());  // of each position among those that stay
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < index.size(); ++i) {
    const std::uint32_t first = first_of_value.empty() ? i : first_of_value[i];
    if (first == i) {
      mesh.positions[kept] = mesh.positions[i];
      index[i] = kept++;
    } else {
      index[i] = index[first];
    }
    if (i % 3 == 2) mesh.triangles.push_back({index[i - 2], index[i - 1], index[i]});
  }
  mesh.positions.resize(kept);
  mesh.positions.shrink_to_fit();
}

}  // namespace facemap
