#include "scene/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "scene/reserve_pages.h"

namespace facemap {

namespace {

/// A run of smoothing and its end.
struct Range {
  std::uint32_t group;
  std::size_t begin, end;  ///< triangles
};

/// The runs that have a group, those of one group side by side and in their order.
std::vector<Range> ranges_by_group(const Mesh& mesh, const std::vector<SmoothingRun>& runs) {
  std::vector<Range> ranges;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t end = i + 1 < runs.size() ? runs[i + 1].first_triangle : mesh.triangles.size();
    if (runs[i].group != 0) ranges.push_back({runs[i].group, runs[i].first_triangle, end});
  }
  std::sort(ranges.begin(), ranges.end(),
            [](const Range& a, const Range& b) { return a.group != b.group ? a.group < b.group : a.begin < b.begin; });
  return ranges;
}

/// Makes normals, one group at a time.
class SmoothNormals {
 public:
  explicit SmoothNormals(Mesh& mesh) : mesh_(mesh), places_(mesh.positions.size(), kNoIndex) {
    reserve_pages(sums_, mesh_.positions.size());
    reserve_pages(mesh_.normals, mesh_.normals.size() + mesh_.positions.size());
  }

  /// `ranges` are all those of a group.
  void add_group(std::span<const Range> ranges) {
    if (std::none_of(ranges.begin(), ranges.end(), [this](const Range& range) { return lacks_normals(range); })) return;
    for (const Range& range : ranges) add_polygons(range);
    make_normals();
    for (const Range& range : ranges) set_normals(range);
    for (const VertexSum& sum : sums_) places_[sum.vertex] = kNoIndex;
    sums_.clear();
  }

 private:
  /// What a vertex has in the group.
  struct VertexSum {
    DVector area;  ///< sum of twice the areas of its polygons, along their normals
    std::uint32_t vertex;
    std::uint32_t last_polygon;  ///< whose area was added last
  };

  bool lacks_normals(const Range& range) const {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Corners& corners = mesh_.normal_corners[i];
      if (std::max({corners[0], corners[1], corners[2]}) == kNoIndex) return true;
    }
    return false;
  }

  void add_polygons(const Range& range) {
    for (std::size_t begin = range.begin; begin != range.end;) {
      const std::uint32_t polygon = polygon_of(begin);
      DVector area = twice_area(begin);
      std::size_t end = begin + 1;
      for (; end != range.end && polygon_of(end) == polygon; ++end) area += twice_area(end);
      for (; begin != end; ++begin) {
        for (const std::uint32_t vertex : mesh_.triangles[begin]) add_area(vertex, area, polygon);
      }
    }
  }

  std::uint32_t polygon_of(std::size_t triangle) const {
    return mesh_.polygons.empty() ? static_cast<std::uint32_t>(triangle) : mesh_.polygons[triangle];
  }

  DVector twice_area(std::size_t triangle) const {
    const DVector a(mesh_.vertex(triangle, 0));
    const DVector b = DVector(mesh_.vertex(triangle, 1)) - a, c = DVector(mesh_.vertex(triangle, 2)) - a;
    return {b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
  }

  void add_area(std::uint32_t vertex, DVector area, std::uint32_t polygon) {
    std::uint32_t& place = places_[vertex];
    if (place == kNoIndex) {
      place = static_cast<std::uint32_t>(sums_.size());
      sums_.push_back({area, vertex, polygon});
      return;
    }
    VertexSum& sum = sums_[place];
    if (sum.last_polygon != polygon) sum.area += area;
    sum.last_polygon = polygon;
  }

  void make_normals() {
    for (const VertexSum& sum : sums_) {
      const DVector area = DVector(0) + sum.area;  // which turns -0 to 0
      const double length = std::sqrt(area.x * area.x + area.y * area.y + area.z * area.z);
      const bool has_normal = length > 0;
      places_[sum.vertex] = has_normal ? static_cast<std::uint32_t>(mesh_.normals.size()) : kNoIndex;
      if (has_normal) mesh_.normals.push_back(Vector(area * (1 / length)));
    }
  }

  void set_normals(const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Corners& vertices = mesh_.triangles[i];
      Corners& normals = mesh_.normal_corners[i];
      for (int k = 0; k < 3; ++k) {
        if (normals[k] == kNoIndex) normals[k] = places_[vertices[k]];
      }
    }
  }

  Mesh& mesh_;
  std::vector<std::uint32_t> places_;  ///< of each vertex in the group: of its sum, and then of its normal
  std::vector<VertexSum> sums_;
};

}  // namespace

void add_smooth_normals(Mesh& mesh, const std::vector<SmoothingRun>& runs) {
  if (mesh.normal_corners.empty()) {
    reserve_pages(mesh.normal_corners, mesh.triangles.size());
    mesh.normal_corners.assign(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  }
  const std::vector<Range> ranges = ranges_by_group(mesh, runs);
  SmoothNormals normals(mesh);
  for (auto begin = ranges.begin(); begin != ranges.end();) {
    const auto end = std::find_if(begin, ranges.end(), [&](const Range& range) { return range.group != begin->group; });
    normals.add_group({begin, end});
    begin = end;
  }
}

}  // namespace facemap
