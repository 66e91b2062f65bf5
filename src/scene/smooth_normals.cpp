#include "scene/smooth_normals.h"

#include <cmath>
#include <map>
#include <utility>

namespace facemap {

namespace {

/// What one vertex has in one smoothing group.
struct VertexSum {
  DVector area{0};  ///< sum of twice the areas of its polygons, along their normals
  std::uint32_t group = 0;
  std::uint32_t last_polygon = kNoIndex;  ///< whose area was added last
  std::uint32_t normal = kNoIndex;        ///< made of `area`
};

class SmoothNormals {
 public:
  explicit SmoothNormals(Mesh& mesh) : mesh_(mesh), first_(mesh.positions.size()) {
    mesh_.normals.reserve(mesh_.normals.size() + mesh_.positions.size());
  }

  /// Adds the areas of polygons, given as triangles [begin, end).
  void add_polygons(std::size_t begin, std::size_t end, std::uint32_t group) {
    while (begin != end) {
      const std::uint32_t polygon = polygon_of(begin);
      std::size_t next = begin;
      DVector area(0);
      for (; next != end && polygon_of(next) == polygon; ++next) area += twice_area(next);
      for (; begin != next; ++begin) {
        for (const std::uint32_t vertex : mesh_.triangles[begin]) {
          VertexSum& sum = sum_at(vertex, group);
          if (sum.last_polygon != polygon) sum.area += area;
          sum.last_polygon = polygon;
        }
      }
    }
  }

  /// Fills in the normals of corners of triangles [begin, end), once all polygons have been added.
  void set_normals(std::size_t begin, std::size_t end, std::uint32_t group) {
    for (; begin != end; ++begin) {
      for (int corner = 0; corner < 3; ++corner) {
        std::uint32_t& normal = mesh_.normal_corners[begin][corner];
        if (normal == kNoIndex) normal = normal_of(sum_at(mesh_.triangles[begin][corner], group));
      }
    }
  }

 private:
  std::uint32_t polygon_of(std::size_t triangle) const {
    return mesh_.polygons.empty() ? static_cast<std::uint32_t>(triangle) : mesh_.polygons[triangle];
  }

  DVector twice_area(std::size_t triangle) const {
    const DVector a(mesh_.vertex(triangle, 0));
    const DVector b = DVector(mesh_.vertex(triangle, 1)) - a, c = DVector(mesh_.vertex(triangle, 2)) - a;
    return {b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
  }

  VertexSum& sum_at(std::uint32_t vertex, std::uint32_t group) {
    VertexSum& first = first_[vertex];
    if (first.group == 0) first.group = group;
    return first.group == group ? first : others_[{vertex, group}];
  }

  std::uint32_t normal_of(VertexSum& sum) {
    if (sum.normal != kNoIndex) return sum.normal;
    const DVector area = sum.area;
    const double length = std::sqrt(area.x * area.x + area.y * area.y + area.z * area.z);
    if (!(length > 0)) return kNoIndex;
    sum.normal = static_cast<std::uint32_t>(mesh_.normals.size());
    mesh_.normals.push_back(Vector(area * (1 / length)));
    return sum.normal;
  }

  Mesh& mesh_;
  std::vector<VertexSum> first_;  ///< of each vertex, in the first group that was seen there
  std::map<std::pair<std::uint32_t, std::uint32_t>, VertexSum> others_;  ///< by vertex and group
};

}  // namespace

void add_smooth_normals(Mesh& mesh, const std::vector<SmoothingRun>& runs) {
  if (mesh.normal_corners.empty()) mesh.normal_corners.assign(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  SmoothNormals normals(mesh);
  const auto for_each_run = [&](auto&& visit) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const std::size_t end = i + 1 < runs.size() ? runs[i + 1].first_triangle : mesh.triangles.size();
      if (runs[i].group != 0) visit(runs[i].first_triangle, end, runs[i].group);
    }
  };
  for_each_run(
      [&](std::size_t begin, std::size_t end, std::uint32_t group) { normals.add_polygons(begin, end, group); });
  for_each_run(
      [&](std::size_t begin, std::size_t end, std::uint32_t group) { normals.set_normals(begin, end, group); });
}

}  // namespace facemap
