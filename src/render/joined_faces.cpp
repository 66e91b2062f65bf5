#include "render/joined_faces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/dvector.h"

namespace facemap {
namespace {

// Of unit normals of flat faces: what a light of intensity 1 adds differs by no more, half a level of 8 bits.
constexpr double kSameNormal = 1.0 / 510;

DVector normal_of(const Mesh& mesh, std::size_t face) {
  const DVector a(mesh.vertex(face, 0));
  return cross(DVector(mesh.vertex(face, 1)) - a, DVector(mesh.vertex(face, 2)) - a);
}

}  // namespace

bool JoinedFaces::know(FaceId a, FaceId b) {
  if (a > b) std::swap(a, b);
  Entry& entry = known_[(static_cast<std::uint32_t>(a) * 31u + static_cast<std::uint32_t>(b)) % known_.size()];
  if (entry.a != a || entry.b != b) {
    entry = {a, b, find(static_cast<std::size_t>(a), static_cast<std::size_t>(b))};
  }
  return entry.are_joined;
}

bool JoinedFaces::is_smooth(std::size_t face) const {
  const Mesh& mesh = scene_.mesh();
  if (normals_ == Renderer::Normals::Flat || mesh.normal_corners.empty()) return false;
  const Corners& normals = mesh.normal_corners[face];
  return std::max({normals[0], normals[1], normals[2]}) != kNoIndex;
}

bool JoinedFaces::have_same_look(std::size_t a, std::size_t b) const {
  const std::vector<std::uint32_t>& materials = scene_.mesh().triangle_materials;
  return materials_ == nullptr || materials.empty() || materials[a] == materials[b];
}

// Whether what is interpolated from the corners is the same at the two.
bool JoinedFaces::are_equal_at(std::size_t a, int corner, std::size_t b, int other) const {
  const Mesh& mesh = scene_.mesh();
  const auto i = static_cast<std::size_t>(corner), j = static_cast<std::size_t>(other);
  if (mesh.triangles[a][i] != mesh.triangles[b][j]) return false;
  if (is_smooth(a) && mesh.normals[mesh.normal_corners[a][i]] != mesh.normals[mesh.normal_corners[b][j]]) return false;
  const bool is_textured = materials_ != nullptr && materials_->has_textures(static_cast<std::uint32_t>(a));
  return !is_textured || mesh.texture_corners.empty() || mesh.texture_corners[a][i] == mesh.texture_corners[b][j];
}

bool JoinedFaces::find(std::size_t a, std::size_t b) const {
  const bool smooth = is_smooth(a);
  if (!have_same_look(a, b) || smooth != is_smooth(b)) return false;
  bool meet = false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) meet = meet || are_equal_at(a, i, b, j);
  }
  if (!meet) return false;
  const Mesh& mesh = scene_.mesh();
  const DVector m = normal_of(mesh, a), n = normal_of(mesh, b), camera(camera_);
  const double towards_a = dot(m, camera - DVector(mesh.vertex(a, 0)));
  const double towards_b = dot(n, camera - DVector(mesh.vertex(b, 0)));
  if (!(towards_a * towards_b > 0)) return false;
  if (smooth) return true;
  const double lengths = std::sqrt(dot(m, m) * dot(n, n));
  const DVector difference = cross(m, n);
  return dot(m, n) > 0 && std::sqrt(dot(difference, difference)) <= kSameNormal * lengths;
}

}  // namespace facemap
