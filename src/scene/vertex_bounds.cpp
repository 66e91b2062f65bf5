#include "scene/vertex_bounds.h"

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <limits>

#include "scene/pieces.h"

namespace facemap {

namespace {

constexpr std::size_t kLeastPiece = 1 << 13;  ///< vertices or faces worth a task of their own

}  // namespace

VertexBounds::VertexBounds(const Mesh& mesh, const std::vector<std::uint32_t>& faces, const Executor& executor)
    : mesh_(mesh), faces_(faces), executor_(executor), used_(mesh.positions.size(), faces.empty()) {
  for_ranges(executor, faces.size(), kLeastPiece, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i != last; ++i) {
      for (const std::uint32_t vertex : mesh_.triangles[faces_[i]]) {
        std::atomic_ref(used_[vertex]).store(1, std::memory_order_relaxed);
      }
    }
  });
}

template <class Visit>
void VertexBounds::for_each_vertex(std::size_t first, std::size_t last, const Visit& visit) const {
  for (std::size_t i = first; i != last; ++i) {
    if (used_[i] != 0) visit(mesh_.positions[i]);
  }
}

std::pair<Vector, Vector> VertexBounds::box() const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Pieces pieces(executor_, used_.size(), kLeastPiece);
  std::vector<std::pair<Vector, Vector>> boxes(pieces.size());
  executor_.for_each(pieces.size(), [&](std::size_t piece, int) {
    Vector lower(kInfinity), upper(-kInfinity);
    for_each_vertex(pieces.begin(piece), pieces.end(piece), [&](const Vector& v) {
      lower = glm::min(lower, v);
      upper = glm::max(upper, v);
    });
    boxes[piece] = {lower, upper};
  });
  auto [lower, upper] = boxes[0];
  for (const auto& box : boxes) {
    lower = glm::min(lower, box.first);
    upper = glm::max(upper, box.second);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (lower[axis] == 0) lower[axis] = first_zero(axis);
    if (upper[axis] == 0) upper[axis] = first_zero(axis);
  }
  return {lower, upper};
}

float VertexBounds::first_zero(int axis) const {
  for (const std::uint32_t face : faces_) {
    for (int corner = 0; corner < 3; ++corner) {
      const float value = mesh_.vertex(face, corner)[axis];
      if (value == 0) return value;
    }
  }
  for (const Vector& position : mesh_.positions) {
    if (position[axis] == 0) return position[axis];
  }
  return 0;
}

double VertexBounds::farthest_squared(const DVector& centre) const {
  const Pieces pieces(executor_, used_.size(), kLeastPiece);
  std::vector<double> farthest(pieces.size());
  executor_.for_each(pieces.size(), [&](std::size_t piece, int) {
    double most = 0;
    for_each_vertex(pieces.begin(piece), pieces.end(piece), [&](const Vector& v) {
      const DVector d = DVector(v) - centre;
      most = std::max(most, d.x * d.x + d.y * d.y + d.z * d.z);
    });
    farthest[piece] = most;
  });
  return *std::max_element(farthest.begin(), farthest.end());
}

}  // namespace facemap
