#include "map/plane_face.h"

#include <algorithm>
#include <cmath>

#include "math/dvector.h"

namespace facemap {
namespace {

// What doubles may lose in an edge's value, relative to the square of the extent in which they stand: a dozen roundings
// of products of two such lengths.
constexpr double kValueError = 0x1p-46;

// Columns by which the place where an edge meets a row may be rounded, within any raster.
constexpr double kColumnRounding = 0x1p-20;

// As in cone.cpp: of a cross product of rotated differences, and of a product of unit vectors.
constexpr double kCrossError = 0x1p-47;
constexpr double kDotError = 0x1p-46;

}  // namespace

PlaneFace::PlaneFace(const MapPoint (&corners)[3], int side, double margin, const MapPoint& origin) {
  double extent = 4;  // of corners and asked texels, in x and y together
  for (int i = 0; i < 3; ++i) {
    const MapPoint &p = corners[i], &q = corners[(i + 1) % 3];
    extent += std::fabs(q.x - p.x) + std::fabs(q.y - p.y);
  }
  // An edge's value is (q - p) x (r - p): p is off by the margin, q - p by twice that.
  const double error = 4 * margin * extent + kValueError * extent * extent;
  for (int i = 0; i < 3; ++i) {
    const MapPoint &p = corners[i], &q = corners[(i + 1) % 3];
    Edge& e = edges_[i];
    // The map's y points down: a face turned away (side 1) runs clockwise on it.
    e.A = -side * (q.y - p.y);
    e.B = side * (q.x - p.x);
    e.C = e.A * (origin.x + 0.5 - p.x) + e.B * (origin.y + 0.5 - p.y);
    e.reach = (std::fabs(e.A) + std::fabs(e.B)) * (0.5 + margin) + error;
    e.negative_inverse = -1 / e.A;
  }
}

PlaneFace::Columns PlaneFace::columns(int row, int last_column, int sign) const {
  double first = 0, last = last_column;
  for (const Edge& e : edges_) {
    const double value = e.B * row + e.C + sign * e.reach;
    if (e.A == 0) {
      if (value < 0) return {0, -1};
      continue;
    }
    const double at = value * e.negative_inverse;
    if (e.A > 0) {
      first = std::max(first, at - sign * kColumnRounding);
    } else {
      last = std::min(last, at + sign * kColumnRounding);
    }
  }
  if (!(first <= last)) return {0, -1};
  return {static_cast<int>(std::ceil(first)), static_cast<int>(std::floor(last))};
}

PlaneDepth::PlaneDepth(const Triangle& face, int side, const SpaceVector& frame, const Projection& projection,
                       double margin)
    : texel_angle_(projection.texel_angle()),
      centre_x_(projection.width() * 0.5),
      centre_y_(projection.height() * 0.5),
      half_texel_(texel_angle_ * (0.5 + margin)) {
  const DVector a(face[0]), b(face[1]), c(face[2]), O(frame.position());
  const DVector u = frame.local_from_world(b - a), v = frame.local_from_world(c - a);
  const DVector n = cross(u, v), corner = frame.local_from_world(a - O);
  const double n_length = length(n);
  // The frame is left-handed in world coordinates: a determinant of local vectors has the other sign.
  normal_ = n_length > 0 ? n * (-side / n_length) : DVector(0);
  normal_slack_ = n_length > 0 ? kCrossError * length(u) * length(v) / n_length + kDotError : 1;
  plane_distance_ = std::fabs(dot(normal_, corner)) + (normal_slack_ + kDotError) * length(corner);
  farthest_corner_ = std::max({length(a - O), length(b - O), length(c - O)}) * (1 + kDotError);
}

double PlaneDepth::farthest(int x, int y) const {
  // Along (X, Y, 1) the plane is plane_distance |(X, Y, 1)| / normal . (X, Y, 1) away.
  const double X = (x + 0.5 - centre_x_) * texel_angle_, Y = (centre_y_ - y - 0.5) * texel_angle_;
  const double slope = normal_.x * X + normal_.y * Y + normal_.z -
                       (std::fabs(normal_.x) + std::fabs(normal_.y)) * half_texel_ -
                       (normal_slack_ + kDotError) * (std::fabs(X) + std::fabs(Y) + 2 + 2 * half_texel_);
  if (!(slope > 0)) return farthest_corner_;
  const double longest = std::sqrt(X * X + Y * Y + 1) + 2 * half_texel_;
  return std::min(farthest_corner_, plane_distance_ * longest / slope * (1 + kDotError));
}

}  // namespace facemap
