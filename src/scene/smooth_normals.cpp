#include "scene/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace facemap {

namespace {

/// The triangles about each vertex that lie in a smoothing group, by ascending id: those of vertex v are
/// triangles[first[v]] to triangles[first[v + 1]]. A triangle that names v twice is there twice.
struct VertexTriangles {
  std::vector<std::uint64_t> first;
  std::vector<std::uint32_t> triangles;
};

VertexTriangles find_vertex_triangles(const Mesh& mesh, const std::vector<std::uint32_t>& groups) {
  VertexTriangles about;
  about.first.assign(mesh.positions.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (groups[t] == 0) continue;
    for (const std::uint32_t vertex : mesh.triangles[t]) ++about.first[vertex];
  }
  std::partial_sum(about.first.begin(), about.first.end(), about.first.begin());
  about.triangles.resize(about.first.back());
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    if (groups[t] == 0) continue;
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      about.triangles[--about.first[vertex]] = static_cast<std::uint32_t>(t);
    }
  }
  return about;
}

std::uint32_t polygon_of(const Mesh& mesh, std::size_t triangle) {
  return mesh.polygons.empty() ? static_cast<std::uint32_t>(triangle) : mesh.polygons[triangle];
}

/// Twice the area of each polygon, along its normal.
std::vector<DVector> polygon_areas(const Mesh& mesh) {
  std::vector<DVector> areas(polygon_of(mesh, mesh.triangles.size() - 1) + std::size_t{1}, DVector(0));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const DVector a(mesh.vertex(t, 0));
    const DVector b = DVector(mesh.vertex(t, 1)) - a, c = DVector(mesh.vertex(t, 2)) - a;
    areas[polygon_of(mesh, t)] += DVector(b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x);
  }
  return areas;
}

/// Gives one normal to the corners at `vertex` of these triangles, all of one group, by ascending id.
void add_normal(Mesh& mesh, const std::vector<DVector>& areas, std::uint32_t vertex,
                std::span<const std::uint32_t> triangles) {
  DVector sum(0);
  std::uint32_t last_polygon = kNoIndex;
  bool is_wanted = false;
  for (const std::uint32_t t : triangles) {
    const std::uint32_t polygon = polygon_of(mesh, t);
    if (polygon != last_polygon) sum += areas[polygon];  // its triangles follow each other
    last_polygon = polygon;
    for (int k = 0; k < 3; ++k) is_wanted |= mesh.triangles[t][k] == vertex && mesh.normal_corners[t][k] == kNoIndex;
  }
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  if (!is_wanted || !(length > 0)) return;

  const auto normal = static_cast<std::uint32_t>(mesh.normals.size());
  mesh.normals.push_back(Vector(sum / length));
  for (const std::uint32_t t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.triangles[t][k] == vertex && mesh.normal_corners[t][k] == kNoIndex) mesh.normal_corners[t][k] = normal;
    }
  }
}

}  // namespace

void add_smooth_normals(Mesh& mesh, const std::vector<std::uint32_t>& smoothing_groups) {
  if (mesh.normal_corners.empty()) mesh.normal_corners.assign(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  VertexTriangles about = find_vertex_triangles(mesh, smoothing_groups);
  const std::vector<DVector> areas = polygon_areas(mesh);
  for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    auto begin = about.triangles.begin() + static_cast<std::ptrdiff_t>(about.first[vertex]);
    const auto end = about.triangles.begin() + static_cast<std::ptrdiff_t>(about.first[vertex + 1]);
    const auto group_of = [&](std::uint32_t t) { return smoothing_groups[t]; };
    std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
      return group_of(a) != group_of(b) ? group_of(a) < group_of(b) : a < b;
    });
    while (begin != end) {
      const auto group_end = std::find_if(begin, end, [&](std::uint32_t t) { return group_of(t) != group_of(*begin); });
      add_normal(mesh, areas, vertex, {begin, group_end});
      begin = group_end;
    }
  }
}

}  // namespace facemap
