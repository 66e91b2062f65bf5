#include "scene/face_neighbours.h"

#include <algorithm>

#include "scene/welded.h"

namespace facemap {
namespace {

// An edge of a face, filed under its lesser vertex.
struct HalfEdge {
  std::uint32_t other;          // the greater vertex
  std::uint32_t face_and_edge;  // 8 face + 2 edge + whether it leaves the greater vertex

  std::uint32_t face() const { return face_and_edge >> 3; }
  std::uint32_t edge() const { return face_and_edge >> 1 & 3; }
  bool leaves_greater() const { return (face_and_edge & 1) != 0; }
};

constexpr std::size_t kMostFaces = std::size_t{1} << 29;

// Half edges by their lesser vertex: those of vertex v are from begins[v] to begins[v + 1].
struct EdgesOfVertices {
  std::vector<std::uint32_t> begins;
  std::vector<HalfEdge> edges;
};

template <class Visit>
void for_each_edge(const Scene& scene, const Visit& visit) {
  for (const std::uint32_t face : scene.kept_faces()) {
    const Corners corners = welded_corners(scene.mesh().triangles[face], scene.welded());
    for (std::uint32_t k = 0; k < 3; ++k) visit(face, k, corners[k], corners[(k + 1) % 3]);
  }
}

EdgesOfVertices file_edges(const Scene& scene) {
  EdgesOfVertices filed;
  filed.begins.assign(scene.mesh().positions.size() + 2, 0);
  // Counts are kept two places on, so that filling moves each begin to where it belongs.
  for_each_edge(scene, [&](std::uint32_t, std::uint32_t, std::uint32_t a, std::uint32_t b) {
    ++filed.begins[std::min(a, b) + 2];
  });
  for (std::size_t v = 2; v < filed.begins.size(); ++v) filed.begins[v] += filed.begins[v - 1];
  filed.edges.resize(filed.begins.back());
  for_each_edge(scene, [&](std::uint32_t face, std::uint32_t k, std::uint32_t a, std::uint32_t b) {
    filed.edges[filed.begins[std::min(a, b) + 1]++] = {std::max(a, b), face << 3 | k << 1 | (a > b ? 1u : 0u)};
  });
  return filed;
}

}  // namespace

std::vector<FaceNeighbours> find_face_neighbours(const Scene& scene) {
  std::vector<FaceNeighbours> neighbours(scene.face_count(), {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  if (scene.face_count() >= kMostFaces) return neighbours;
  EdgesOfVertices filed = file_edges(scene);
  for (std::size_t v = 0; v + 1 < filed.begins.size(); ++v) {
    HalfEdge* const end = filed.edges.data() + filed.begins[v + 1];
    HalfEdge* first = filed.edges.data() + filed.begins[v];
    std::sort(first, end, [](const HalfEdge& a, const HalfEdge& b) { return a.other < b.other; });
    while (first != end) {
      const HalfEdge* const next = std::find_if(first, end, [&](const HalfEdge& e) { return e.other != first->other; });
      if (next - first == 2 && first[0].leaves_greater() != first[1].leaves_greater()) {
        neighbours[first[0].face()][first[0].edge()] = first[1].face();
        neighbours[first[1].face()][first[1].edge()] = first[0].face();
      }
      first += next - first;
    }
  }
  return neighbours;
}

}  // namespace facemap
