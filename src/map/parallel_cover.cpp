#include "map/parallel_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/face_planes.h"
#include "map/plane_face.h"
#include "map/texel_box.h"
#include "map/texels.h"
#include "math/dvector.h"

namespace facemap {
namespace {

// Room that is made beforehand, entries a face.
constexpr std::size_t kEntriesExpected = 6;

// Of the normal's components, relative to the product of two edges: differences, the rotation, the products.
constexpr double kNormalError = 0x1p-45;

/// Upper bounds of a face's z over texels that it covers, world units.
class DepthOverTexels {
 public:
  DepthOverTexels(const Triangle& face, const ParallelFrame& frame) : frame_(frame) {
    farthest_corner_ = -HUGE_VAL;
    DVector at[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = frame.local(DVector(face[k]) - DVector(frame.origin()));
      farthest_corner_ = std::max(farthest_corner_, at[k].z);
    }
    const DVector u = frame.local(DVector(face[1]) - DVector(face[0]));
    const DVector v = frame.local(DVector(face[2]) - DVector(face[0]));
    const DVector n = cross(u, v);
    const double error = kNormalError * length(u) * length(v), least = std::fabs(n.z) - error;
    has_slope_ = least > error;
    if (!has_slope_) return;
    // Along x the plane rises by -n.x / n.z, off by at most (error + |n.x / n.z| error) / least.
    slope_x_ = -n.x / n.z;
    slope_y_ = -n.y / n.z;
    slope_error_ = error * (2 + std::fabs(slope_x_) + std::fabs(slope_y_)) / least;
    corner_ = at[0];
    map_corner_ = frame.map_point(at[0]);
    // Half a texel each way, and what map points and the corner are off by.
    reach_ = (std::fabs(slope_x_) + std::fabs(slope_y_)) * (0.5 + 2 * frame.margin()) * frame.texel();
  }

  double farthest(int x, int y) const {
    if (!has_slope_) return farthest_corner_;
    const double dx = (x + 0.5 - map_corner_.x) * frame_.texel(), dy = (map_corner_.y - y - 0.5) * frame_.texel();
    const double error = slope_error_ * (std::fabs(dx) + std::fabs(dy) + 2 * frame_.texel());
    return std::min(farthest_corner_, corner_.z + slope_x_ * dx + slope_y_ * dy + reach_ + error);
  }

 private:
  const ParallelFrame& frame_;
  double farthest_corner_, slope_x_ = 0, slope_y_ = 0, slope_error_ = 0, reach_ = 0;
  bool has_slope_;
  DVector corner_{0};
  MapPoint map_corner_{0};
};

class Builder {
 public:
  Builder(const Scene& scene, const ParallelFrame& frame, const ParallelFaces& faces, bool keep_all)
      : scene_(scene), frame_(frame), faces_(faces) {
    const std::vector<Vector>& positions = scene.mesh().positions;
    points_.reserve(positions.size());
    for (const Vector& v : positions) {
      points_.push_back(frame.map_point(frame.local(DVector(v) - DVector(frame.origin()))));
    }
    if (!keep_all) {
      const auto texels = static_cast<std::size_t>(frame.width()) * static_cast<std::size_t>(frame.height());
      coverage_.cuts.assign(texels, std::numeric_limits<float>::infinity());
    }
  }

  Coverage build() {
    for (const std::uint32_t id : scene_.kept_faces()) {
      if (!coverage_.cuts.empty() && faces_.side(id) != 0) cut(id);
    }
    coverage_.entries.reserve(kEntriesExpected * scene_.kept_faces().size());
    for (const std::uint32_t id : scene_.kept_faces()) {
      if (faces_.side(id) != 0) enter(id);
    }
    return std::move(coverage_);
  }

 private:
  struct Corners {
    MapPoint of[3];
  };

  Corners corners_of(std::uint32_t id) const {
    const auto& corner = scene_.mesh().triangles[id];
    return {{points_[corner[0]], points_[corner[1]], points_[corner[2]]}};
  }

  // Calls task(texel, column, row) for the texels of the box that `columns` gives of each row.
  template <class Columns, class Task>
  void for_each_texel(const TexelBox& box, const Columns& columns, const Task& task) {
    for (int y = box.y0; y <= box.y1; ++y) {
      const PlaneFace::Columns some = columns(y - box.y0, box.x1 - box.x0);
      const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width());
      for (int x = box.x0 + some.first; x <= box.x0 + some.last; ++x) task(row + static_cast<std::size_t>(x), x, y);
    }
  }

  TexelBox clipped(const TexelBox& box) const {
    return {std::max(box.x0, 0), std::max(box.y0, 0), std::min(box.x1, frame_.width() - 1),
            std::min(box.y1, frame_.height() - 1)};
  }

  void cut(std::uint32_t id) {
    const Corners corners = corners_of(id);
    const TexelBox whole = box_around(corners.of, frame_.margin());
    // No texel is covered by a face that does not go beyond it on all sides.
    if (whole.x1 - whole.x0 < 2 || whole.y1 - whole.y0 < 2) return;
    const TexelBox box = clipped(whole);
    const PlaneFace face(corners.of, faces_.side(id), frame_.margin(), MapPoint(box.x0, box.y0));
    const DepthOverTexels depth(triangle_of(scene_, id), frame_);
    for_each_texel(
        box, [&](int row, int last) { return face.covered(row, last); },
        [&](std::size_t texel, int x, int y) {
          float& cut = coverage_.cuts[texel];
          if (!Texels::is_hidden(faces_.nearest(id), cut)) {
            cut = std::min(cut, float_above(frame_.depth(depth.farthest(x, y))));
          }
        });
  }

  void enter(std::uint32_t id) {
    const Corners corners = corners_of(id);
    const TexelBox box = clipped(box_around(corners.of, frame_.margin()));
    if (box.is_empty()) return;
    const PlaneFace face(corners.of, faces_.side(id), frame_.margin(), MapPoint(box.x0, box.y0));
    const float nearest = faces_.nearest(id);
    for_each_texel(
        box, [&](int row, int last) { return face.touched(row, last); },
        [&](std::size_t texel, int, int) {
          if (!coverage_.cuts.empty() && Texels::is_hidden(nearest, coverage_.cuts[texel])) return;
          coverage_.entries.push_back({static_cast<std::uint32_t>(texel), id, nearest});
        });
  }

  const Scene& scene_;
  const ParallelFrame& frame_;
  const ParallelFaces& faces_;
  std::vector<MapPoint> points_;  // of vertices
  Coverage coverage_;
};

}  // namespace

Coverage cover_faces_along(const Scene& scene, const ParallelFrame& frame, const ParallelFaces& faces, bool keep_all) {
  return Builder(scene, frame, faces, keep_all).build();
}

}  // namespace facemap
