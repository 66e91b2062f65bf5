#include "map/plane_cover.h"

#include <algorithm>
#include <cmath>

#include "map/plane_face.h"
#include "map/texels.h"
#include "math/dvector.h"

namespace facemap {
namespace {

// Well in front: a corner's depth is at least this share of its distance. 1/share^2 bounds how much the projection
// stretches an angular error.
constexpr double kForwardShare = 1.0 / 64;

// Within this tangent of the axis a direction's error is stretched by no more than that.
constexpr double kWidestEdge = 32;

// Relative, of a local offset: its rounding, with a wide reserve.
constexpr double kOffsetError = 0x1p-45;

}  // namespace

struct PlaneCover::Image {
  PlaneFace face;
  TexelBox box;  // of the raster

  int last_column() const { return box.x1 - box.x0; }
};

PlaneCover::PlaneCover(const Scene& scene, const SpaceVector& frame, const Projection& projection,
                       const FacePlanesTable& planes, Coverage& out)
    : scene_(scene), frame_(frame), projection_(projection), planes_(planes), out_(out) {
  const double angular_error = kDirectionError + 2 * Projection::kMapError;
  margin_ = angular_error / (kForwardShare * kForwardShare) / projection.texel_angle() + kCoordinateRounding;
  const double past = 0.5 + margin_ / std::min(projection.width(), projection.height());
  edge_x_ = projection.width() * projection.texel_angle() * past;
  edge_y_ = projection.height() * projection.texel_angle() * past;
  if (std::max(edge_x_, edge_y_) > kWidestEdge) edge_x_ = edge_y_ = HUGE_VAL;
  project_vertices();
}

// A direction of the raster has z > 0, |x| < edge_x_ z and |y| < edge_y_ z. If for all three corners of a face one of
// these surely fails, it does so for all of the face.
std::uint8_t PlaneCover::sides_outside(const DVector& p) const {
  const double error = kOffsetError * (1 + edge_x_ + edge_y_) * length(p);
  const double x = edge_x_ * p.z, y = edge_y_ * p.z;
  const bool fails[] = {p.z<-error, p.x - x> error, -p.x - x > error, p.y - y > error, -p.y - y > error};
  std::uint8_t bits = 0;
  for (int i = 0; i < 5; ++i) bits = static_cast<std::uint8_t>(bits | fails[i] << i);
  return bits;
}

void PlaneCover::project_vertices() {
  const std::vector<Vector>& positions = scene_.mesh().positions;
  const DVector O(frame_.position());
  points_.resize(positions.size());
  outside_.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const DVector p = frame_.local_from_world(DVector(positions[i]) - O);
    const bool is_in_front = p.z > kForwardShare * length(p);
    points_[i] = is_in_front ? projection_.map_from_local(p) : MapPoint(HUGE_VAL);
    outside_[i] = sides_outside(p);
  }
}

bool PlaneCover::is_outside(std::uint32_t id) const {
  const auto& corner = scene_.mesh().triangles[id];
  return (outside_[corner[0]] & outside_[corner[1]] & outside_[corner[2]]) != 0;
}

std::size_t PlaneCover::count_faces() const {
  const std::vector<std::uint32_t>& ids = scene_.kept_faces();
  return static_cast<std::size_t>(std::count_if(ids.begin(), ids.end(), [this](auto id) { return !is_outside(id); }));
}

bool PlaneCover::add(std::uint32_t id, Pass pass) {
  const auto& corner = scene_.mesh().triangles[id];
  if (is_outside(id)) return true;
  const MapPoint corners[] = {points_[corner[0]], points_[corner[1]], points_[corner[2]]};
  if (!(corners[0].x + corners[1].x + corners[2].x < HUGE_VAL)) return false;
  const TexelBox whole = box_around(corners, margin_);
  // No texel is covered by a face that does not go beyond it on all sides.
  if (pass == Pass::Cuts && (whole.x1 - whole.x0 < 2 || whole.y1 - whole.y0 < 2)) return true;
  const TexelBox box = whole.clipped(projection_);
  if (box.is_empty()) return true;
  const Image image{PlaneFace(corners, planes_.side(id), margin_, MapPoint(box.x0, box.y0)), box};
  pass == Pass::Cuts ? cut(id, image) : enter(id, image);
  return true;
}

void PlaneCover::cut(std::uint32_t id, const Image& image) {
  const PlaneDepth depth(triangle_of(scene_, id), planes_.side(id), frame_, projection_, margin_);
  for (int y = image.box.y0; y <= image.box.y1; ++y) {
    const PlaneFace::Columns covered = image.face.covered(y - image.box.y0, image.last_column());
    float* cuts = out_.cuts.data() + row_of(y);
    for (int x = image.box.x0 + covered.first; x <= image.box.x0 + covered.last; ++x) {
      if (Texels::is_hidden(planes_.nearest(id), cuts[x])) continue;
      cuts[x] = std::min(cuts[x], float_above(depth.farthest(x, y) * planes_.scale()));
    }
  }
}

void PlaneCover::enter(std::uint32_t id, const Image& image) {
  const float nearest = planes_.nearest(id);
  for (int y = image.box.y0; y <= image.box.y1; ++y) {
    const PlaneFace::Columns touched = image.face.touched(y - image.box.y0, image.last_column());
    for (int x = image.box.x0 + touched.first; x <= image.box.x0 + touched.last; ++x) {
      const std::size_t texel = row_of(y) + static_cast<std::size_t>(x);
      if (!out_.cuts.empty() && Texels::is_hidden(nearest, out_.cuts[texel])) continue;
      out_.entries.push_back({static_cast<std::uint32_t>(texel), id, nearest});
    }
  }
}

}  // namespace facemap
