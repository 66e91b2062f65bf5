#include "visibility/face_piece.h"

#include <algorithm>
#include <cmath>

#include "math/plain_bounds.h"
#include "math/power_of_two.h"
#include "scene/welded.h"

namespace facemap {
namespace {

using plain::bound;

// As in math/plain_bounds.h: roundings and monomials of what is computed below. A corner of a piece from the origin is
// first + (w1 first_edge + w2 last_edge) / scale: 4 roundings, magnitudes together at most `reach`. A side of a piece
// is (d1 first_edge + d2 last_edge) / scale: 3 roundings, at most 2 |d| edge / scale.
constexpr double kSideProduct = bound(4 + 3 + 2 + 1 + 3, 6);    // (corner x side) . offset
constexpr double kEdgeProduct = bound(1 + 1 + 2 + 4 + 3, 6);    // (offset x edge) . corner
constexpr double kOwnPlaneProduct = bound(4 + 1 + 3, 6);        // normal . (corner of another face - own corner)
constexpr double kOtherPlaneProduct = bound(4 + 4 + 1 + 3, 6);  // other's normal . (other's offset - corner)

double largest(const DVector& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

DVector difference(const Vector& a, const Vector& b) { return DVector(a) - DVector(b); }

}  // namespace

SeenVertex::SeenVertex(const Vector& at, std::uint32_t number, const Vector& origin)
    : position(at), vertex(number), offset(difference(at, origin)), size(largest(offset)) {}

SeenFace::SeenFace(const Scene& scene, std::uint32_t face, int face_side, const Vector& origin)
    : id(face), side(face_side) {
  const Corners& corners = scene.mesh().triangles[face];
  const Corners welded = welded_corners(corners, scene.welded());
  for (std::size_t k = 0; k < 3; ++k) {
    vertices[k] = SeenVertex(scene.mesh().positions[corners[k]], welded[k], origin);
  }
  first_edge = difference(vertices[1].position, vertices[0].position);
  last_edge = difference(vertices[2].position, vertices[0].position);
  normal = cross(first_edge, last_edge);
  edge = std::max(
      {largest(first_edge), largest(last_edge), largest(difference(vertices[2].position, vertices[1].position))});
  reach = vertices[0].size + edge;
}

FacePiece::FacePiece(const SeenFace& face, const Vector& origin)
    : FacePiece(face, nullptr, origin, 1, {Weights{1, 0, 0}, Weights{0, 1, 0}, Weights{0, 0, 1}}) {}

FacePiece::FacePiece(const SeenFace& face, const FacePiece* whole, const Vector& origin, std::uint64_t scale,
                     const std::array<Weights, 3>& weights)
    : face_(&face), whole_(whole), origin_(origin), scale_(scale), weights_(weights) {
  const double part = 1 / static_cast<double>(scale);
  const auto weight = [&](std::size_t i, std::size_t k) { return static_cast<double>(weights[i][k]); };
  for (std::size_t i = 0; i < 3; ++i) {
    points_[i] = face.vertices[0].offset + (weight(i, 1) * face.first_edge + weight(i, 2) * face.last_edge) * part;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const double d1 = weight(next, 1) - weight(i, 1), d2 = weight(next, 2) - weight(i, 2);
    const DVector along = (d1 * face.first_edge + d2 * face.last_edge) * part;
    sides_[i].normal = static_cast<double>(face.side) * cross(points_[i], along);
    sides_[i].error = kSideProduct * face.reach * (std::fabs(d1) + std::fabs(d2)) * part * face.edge;
  }
}

Vector FacePiece::middle() const {
  const DVector middle = points_[0] + points_[1] + points_[2];
  // Its length is free: about 1, so that all bits of a float count.
  return Vector(middle * inverse_power_of_two(largest(middle)));
}

bool FacePiece::surely_holds(const Vector& direction) const {
  if (is_whole()) return true;
  const DVector d(direction);
  const double size = largest(d);
  return std::all_of(sides_.begin(), sides_.end(),
                     [&](const Side& side) { return dot(side.normal, d) > side.error * size; });
}

// The vertex that corner i is, or null.
const SeenVertex* FacePiece::corner_of_face(std::size_t i) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights_[i][k] == scale_) return &face_->vertices[k];
  }
  return nullptr;
}

// Whether a vertex surely lies beyond the plane of a side, or on it where that is the face's outline or a corner.
bool FacePiece::is_outside(std::size_t side, const SeenVertex& p) const {
  const double value = dot(sides_[side].normal, p.offset), error = sides_[side].error * p.size;
  if (value < -error) return true;
  if (value > error) return false;
  const SeenVertex *from = corner_of_face(side), *to = corner_of_face((side + 1) % 3);
  if ((from != nullptr && p.vertex == from->vertex) || (to != nullptr && p.vertex == to->vertex)) return true;
  if (from == nullptr || to == nullptr) return false;
  return face_->side * facemap::side({from->position, to->position, p.position}, origin_) <= 0;
}

// Whether the corners surely lie to one side of the plane of an edge; those of the face may lie on it, but not all.
bool FacePiece::is_to_one_side_of(const SeenVertex& p, const SeenVertex& q) const {
  const DVector edge = difference(q.position, p.position);
  const DVector normal = cross(p.offset, edge);
  const double error = kEdgeProduct * p.size * largest(edge) * face_->reach;
  int common = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = dot(normal, points_[i]);
    int sign = value > error ? 1 : -1;
    if (std::fabs(value) <= error) {
      const SeenVertex* corner = corner_of_face(i);
      if (corner == nullptr) return false;
      if (corner->vertex == p.vertex || corner->vertex == q.vertex) continue;
      sign = facemap::side({p.position, q.position, corner->position}, origin_);
    }
    if (sign * common < 0) return false;
    if (sign != 0) common = sign;
  }
  return common != 0;
}

// A side that leaves a corner of the face which the edge shares is met there at most, if the edge's other end is beyond
// it: a corner of the face is not part of the piece.
bool FacePiece::surely_misses(const SeenVertex& p, const SeenVertex& q) const {
  for (std::size_t side = 0; side < 3; ++side) {
    if (is_outside(side, p) && is_outside(side, q)) return true;
  }
  return is_to_one_side_of(p, q);
}

bool FacePiece::may_meet(const SeenVertex& p, const SeenVertex& q) const {
  return !surely_misses(p, q) && (is_whole() || !whole_->surely_misses(p, q));
}

// Whether no corner of `other` is beyond the face's plane, and those on it do no harm: they are corners of the face
// too, or equals yield as well.
bool FacePiece::is_behind_corners_of(const SeenFace& other, bool other_wins_ties) const {
  bool is_strict = false;
  for (const SeenVertex& g : other.vertices) {
    if (face_->has(g.vertex)) continue;
    const DVector offset = difference(face_->vertices[0].position, g.position);
    const double value = face_->side * dot(face_->normal, offset);
    const double error = kOwnPlaneProduct * face_->edge * face_->edge * largest(offset);
    if (value < -error) return false;
    if (value <= error) {
      const int sign = face_->side * facemap::side(face_->triangle(), g.position);
      if (sign < 0 || (sign == 0 && !other_wins_ties)) return false;
      if (sign == 0) continue;
    }
    is_strict = true;
  }
  return is_strict || other_wins_ties;
}

// Whether no corner is before the plane of `other`; those of the face may lie on it, but not all.
bool FacePiece::is_behind_plane_of(const SeenFace& other) const {
  const double error = kOtherPlaneProduct * other.edge * other.edge * (other.vertices[0].size + face_->reach);
  bool is_strict = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = -other.side * dot(other.normal, other.vertices[0].offset - points_[i]);
    if (value < -error) return false;
    if (value <= error) {
      const SeenVertex* corner = corner_of_face(i);
      if (corner == nullptr) return false;
      if (other.has(corner->vertex)) continue;
      const int sign = -other.side * facemap::side(other.triangle(), corner->position);
      if (sign < 0) return false;
      if (sign == 0) continue;
    }
    is_strict = true;
  }
  return is_strict;
}

bool FacePiece::surely_yields_to(const SeenFace& other) const {
  const bool other_wins_ties = other.side != face_->side ? other.side < face_->side : other.id < face_->id;
  return is_behind_corners_of(other, other_wins_ties) || is_behind_plane_of(other) ||
         (!is_whole() && whole_->is_behind_plane_of(other));
}

}  // namespace facemap
