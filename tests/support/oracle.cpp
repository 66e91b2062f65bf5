#include "support/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "support/big_numbers.h"

namespace oracle {
namespace {

// ---- exact integers -------------------------------------------------------------------------------------

// A face's corner a and normal n.
struct BigPlane {
  BigVector a, n;
};
BigPlane big_plane(const Vector& a, const Vector& b, const Vector& c) {
  const BigVector A = big(a);
  return {A, cross(big(b) - A, big(c) - A)};
}
BigPlane big_plane(const Mesh& mesh, FaceId face) {
  return big_plane(mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2));
}

bool is_zero(const Vector& d) { return d.x == 0 && d.y == 0 && d.z == 0; }

// ---- doubles with a bound -------------------------------------------------------------------------------

struct D3 {
  double x, y, z;
};
D3 minus(const Vector& a, const Vector& b) {
  return {double(a.x) - double(b.x), double(a.y) - double(b.y), double(a.z) - double(b.z)};
}
double length(const D3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

// With u = 2^-53: differences of floats are off by u, a product of two of them by 3.1 u, a component of u x v by
// 4.2 u times its sum of magnitudes, which is at most 2 max|u| max|v|. A product of that with a rounded target
// (8 u) is off by less than 14 u, the sum of three by less than 17 u. 2^-48 = 32 u covers all with room.
constexpr double kRelativeError = 0x1p-48;

double largest(const D3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

// ---- which faces count ----------------------------------------------------------------------------------

using PositionTriple = std::array<std::array<float, 3>, 3>;

PositionTriple sorted_positions(const Mesh& mesh, FaceId face) {
  PositionTriple corners;
  for (int i = 0; i < 3; ++i) {
    const Vector& v = mesh.vertex(face, i);
    corners[i] = {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f};  // -0 becomes 0
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

bool has_zero_area(const Vector& a, const Vector& b, const Vector& c) {
  const BigVector n = big_plane(a, b, c).n;
  return n.x == 0 && n.y == 0 && n.z == 0;
}

Oracle::Oracle(const Mesh& mesh, const Holes* holes) : mesh_(&mesh), holes_(holes), kept_(mesh.face_count(), 0) {
  std::map<PositionTriple, FaceId> seen;
  for (std::size_t i = 0; i < mesh.face_count(); ++i) {
    const auto face = static_cast<FaceId>(i);
    if (has_zero_area(mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2))) continue;
    if (kind(face) == Holes::Kind::Gone) continue;
    if (kind(face) == Holes::Kind::Solid && !seen.emplace(sorted_positions(mesh, face), face).second) continue;
    kept_[i] = 1;
    kept_faces_.push_back(face);
  }
}

View Oracle::from(const Vector& origin) const { return View(*this, origin, true); }
View Oracle::from_by_integers(const Vector& origin) const { return View(*this, origin, false); }

int Oracle::side(FaceId face, const Vector& origin) const {
  const BigPlane p = big_plane(*mesh_, face);
  return sgn(dot(p.n, p.a - big(origin)));
}

// ---- a view ---------------------------------------------------------------------------------------------

View::View(const Oracle& oracle, const Vector& origin, bool use_doubles)
    : oracle_(&oracle), origin_(origin), use_doubles_(use_doubles) {
  for (const FaceId face : oracle.kept_faces()) {
    const int s = oracle.side(face, origin);
    if (s == 0) continue;  // seen edge-on: met by nothing
    const Mesh& mesh = oracle.mesh();
    std::array<D3, 3> corner, side;
    for (int i = 0; i < 3; ++i) {
      corner[i] = minus(mesh.vertex(face, i), origin);
      side[i] = minus(mesh.vertex(face, (i + 1) % 3), mesh.vertex(face, i));
    }
    const auto plane = [s](const D3& u, const D3& v) {
      Plane p{s * (u.y * v.z - u.z * v.y), s * (u.z * v.x - u.x * v.z), s * (u.x * v.y - u.y * v.x), 0, 0, 0};
      p.error = kRelativeError * 2 * largest(u) * largest(v);
      return p;
    };
    FacePlanes planes{face, s, {}, {}};
    for (int i = 0; i < 3; ++i) planes.edges[i] = plane(corner[i], side[i]);  // A x (B-A) = A x B
    planes.own = plane(side[0], side[1]);
    const Plane& n = planes.own;
    planes.own.offset = n.x * corner[0].x + n.y * corner[0].y + n.z * corner[0].z;
    planes.own.offset_error = 3 * n.error * largest(corner[0]);
    faces_.push_back(planes);

    // If axis . A >= k |A| for the three corners and k >= 0, then for X = p A + q B + r C with p, q, r >= 0:
    // axis . X >= k (p |A| + q |B| + r |C|) >= k |X|.
    D3 axis{0, 0, 0};
    for (const D3& A : corner) {
      const double l = length(A);
      axis = {axis.x + A.x / l, axis.y + A.y / l, axis.z + A.z / l};
    }
    const double l = length(axis);
    axis = {axis.x / l, axis.y / l, axis.z / l};
    double k = 2;
    for (const D3& A : corner) k = std::min(k, (axis.x * A.x + axis.y * A.y + axis.z * A.z) / length(A));
    constexpr double kFloatMargin = 1e-5;  // eight roundings of floats near 1: below 1e-6
    const bool is_bounded = k > 2 * kFloatMargin;
    axis_x_.push_back(static_cast<float>(is_bounded ? axis.x : 0));
    axis_y_.push_back(static_cast<float>(is_bounded ? axis.y : 0));
    axis_z_.push_back(static_cast<float>(is_bounded ? axis.z : 0));
    cosine_.push_back(is_bounded ? static_cast<float>(k - kFloatMargin) : -2.0f);
  }
}

Target View::target_from(const BigVector& X, const mpz_class& w) const {
  if (!use_doubles_) return {X, w, {kUnknown, kUnknown, kUnknown}};
  return {X, w, {rounded_quotient(X.x, w), rounded_quotient(X.y, w), rounded_quotient(X.z, w)}};
}

// A ray's end is at infinity: only its direction counts.
Target View::target_from(const Vector& d) const {
  if (!use_doubles_) return {big(d), 1, {kUnknown, kUnknown, kUnknown}};
  return {big(d), 1, {d.x, d.y, d.z}};
}

// Visits the faces whose cone may hold the target.
template <class Visit>
void View::for_each_near(const Target& target, Visit visit) const {
  const D3 t{target.rounded[0], target.rounded[1], target.rounded[2]};
  const double scale = 1 / length(t);
  const bool is_usable = scale > 0x1p-300 && scale < 0x1p300;  // else (NaN as well) ask all
  const float x = is_usable ? static_cast<float>(t.x * scale) : 0, y = is_usable ? static_cast<float>(t.y * scale) : 0,
              z = is_usable ? static_cast<float>(t.z * scale) : 0;
  constexpr std::size_t kBlock = 64;
  std::array<float, kBlock> excess;
  for (std::size_t begin = 0; begin < faces_.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, faces_.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t f = begin + i;
      excess[i] = axis_x_[f] * x + axis_y_[f] * y + axis_z_[f] * z - cosine_[f];
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (excess[i] < 0 && is_usable) continue;
      if (!visit(begin + i)) return;
    }
  }
}

int View::exact_edge_sign(const FacePlanes& planes, int edge, const Target& target) const {
  ++exact_signs_;
  const Mesh& mesh = oracle_->mesh();
  const BigVector O = big(origin_);
  const BigVector A = big(mesh.vertex(planes.face, edge)) - O, B = big(mesh.vertex(planes.face, (edge + 1) % 3)) - O;
  return planes.s * sgn(dot(cross(A, B), target.X));
}

int View::edge_sign(const FacePlanes& planes, int edge, const Target& target) const {
  const Plane& p = planes.edges[edge];
  const auto& t = target.rounded;
  const double value = p.x * t[0] + p.y * t[1] + p.z * t[2];
  const double bound = p.error * (std::fabs(t[0]) + std::fabs(t[1]) + std::fabs(t[2]));
  if (value > bound) return 1;
  if (value < -bound) return -1;
  return exact_edge_sign(planes, edge, target);
}

bool View::meets(const FacePlanes& planes, const Target& target, bool* strictly_inside) const {
  const auto& t = target.rounded;
  const double size = std::fabs(t[0]) + std::fabs(t[1]) + std::fabs(t[2]);
  for (const Plane& p : planes.edges) {  // most faces fail one edge for sure: no need to know the others
    if (p.x * t[0] + p.y * t[1] + p.z * t[2] < -p.error * size) return false;
  }
  *strictly_inside = true;
  for (int edge = 0; edge < 3; ++edge) {
    const int sign = edge_sign(planes, edge, target);
    if (sign < 0) return false;
    if (sign == 0) *strictly_inside = false;
  }
  return true;
}

// s (n . X - w n . A) > 0: the target is strictly beyond the face's plane.
bool View::is_beyond(const FacePlanes& planes, const Target& target) const {
  const Plane& p = planes.own;
  const auto& t = target.rounded;
  const double value = p.x * t[0] + p.y * t[1] + p.z * t[2] - p.offset;
  const double bound =
      2 * (p.error * (std::fabs(t[0]) + std::fabs(t[1]) + std::fabs(t[2])) + p.offset_error);  // 2: the difference
  if (value > bound) return true;
  if (value < -bound) return false;
  ++exact_signs_;
  const BigPlane plane = big_plane(oracle_->mesh(), planes.face);
  const mpz_class height = dot(plane.n, plane.a - big(origin_));
  return planes.s * sgn(mpz_class(dot(plane.n, target.X) - target.w * height)) > 0;
}

std::vector<View::Meeting> View::all_meetings(const Vector& d) const {
  const Target target = target_from(d);
  const Holes::Point from{origin_.x, origin_.y, origin_.z}, along{d.x, d.y, d.z};
  std::vector<Meeting> result;
  for_each_near(target, [&](std::size_t i) {
    bool strictly_inside = false;
    if (meets(faces_[i], target, &strictly_inside) && oracle_->is_there(faces_[i].face, from, along))
      result.push_back({i, strictly_inside});
    return true;
  });
  return result;
}

// Sign of t_f - t_g, t = (n . A) / (n . d). Both are met, so s n . A > 0 and s n . d > 0.
int View::compare_distance(const FacePlanes& f, const FacePlanes& g, const Target& target) const {
  const auto& d = target.rounded;
  const double size = std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]);
  const auto interval = [&](const Plane& p) {  // of t, widened by far more than the roundings of this function
    constexpr double kWiden = 1e-12;
    const double slope = p.x * d[0] + p.y * d[1] + p.z * d[2];
    const double low = (p.offset - p.offset_error) / (slope + p.error * size);
    const double divisor = slope - p.error * size;
    const double high = divisor > 0 ? (p.offset + p.offset_error) / divisor : HUGE_VAL;
    return std::array<double, 2>{low * (1 - kWiden), high * (1 + kWiden)};
  };
  const auto t_f = interval(f.own), t_g = interval(g.own);
  if (t_f[1] < t_g[0]) return -1;
  if (t_f[0] > t_g[1]) return 1;
  ++exact_signs_;
  const BigVector O = big(origin_);
  const BigPlane p = big_plane(oracle_->mesh(), f.face), q = big_plane(oracle_->mesh(), g.face);
  const mpz_class left = dot(p.n, p.a - O) * dot(q.n, target.X), right = dot(q.n, q.a - O) * dot(p.n, target.X);
  return f.s * g.s * sgn(mpz_class(left - right));
}

Hit View::nearest(const Vector& direction) const {
  if (is_zero(direction)) return {};
  const Target target = target_from(direction);
  const std::vector<Meeting> meetings = all_meetings(direction);
  if (meetings.empty()) return {};
  const Meeting* best = &meetings[0];
  bool tied = false;
  for (std::size_t i = 1; i < meetings.size(); ++i) {
    const FacePlanes &challenger = faces_[meetings[i].index], &holder = faces_[best->index];
    const int order = compare_distance(challenger, holder, target);
    if (order == 0) tied = true;
    if (order > 0) continue;
    if (order < 0) tied = false;
    // Faces come in order of id: among equals only one turned towards O displaces one turned away.
    if (order < 0 || (challenger.s < 0 && holder.s > 0)) best = &meetings[i];
  }
  const FacePlanes& winner = faces_[best->index];
  return {winner.face, best->strictly_inside, tied, winner.s};
}

int View::count_hits(const Vector& direction) const {
  return is_zero(direction) ? 0 : static_cast<int>(all_meetings(direction).size());
}

bool View::comes_before(const FacePlanes& f, const FacePlanes& g, const Target& target) const {
  const int order = compare_distance(f, g, target);
  if (order != 0) return order < 0;
  return f.s != g.s ? f.s < g.s : f.face < g.face;
}

std::vector<FaceId> View::all_hits(const Vector& direction) const {
  if (is_zero(direction)) return {};
  const Target target = target_from(direction);
  std::vector<Meeting> meetings = all_meetings(direction);
  std::sort(meetings.begin(), meetings.end(), [&](const Meeting& a, const Meeting& b) {
    return a.index != b.index && comes_before(faces_[a.index], faces_[b.index], target);
  });
  std::vector<FaceId> faces;
  for (const Meeting& meeting : meetings) faces.push_back(faces_[meeting.index].face);
  return faces;
}

bool View::meets(FaceId face, const Vector& direction) const {
  if (is_zero(direction)) return false;
  const auto found =
      std::find_if(faces_.begin(), faces_.end(), [face](const FacePlanes& planes) { return planes.face == face; });
  bool strictly_inside = false;
  return found != faces_.end() && meets(*found, target_from(direction), &strictly_inside);
}

double View::distance(FaceId face, const Vector& direction) const {
  const BigPlane p = big_plane(oracle_->mesh(), face);
  const BigVector d = big(direction);
  // t = (n . A) / (n . d): both carry the same powers of 2^149.
  const double t = rounded_quotient(mpz_class(dot(p.n, p.a - big(origin_)) << 149), dot(p.n, d));
  return t * length({direction.x, direction.y, direction.z});
}

// ---- lit or not -----------------------------------------------------------------------------------------

// The ray K + t d meets the plane of F at t = n . (a - K) / n . d.
Target View::target_of(const SurfacePoint& point) const {
  const BigPlane F = big_plane(point.vertices[0], point.vertices[1], point.vertices[2]);
  const BigVector K = big(point.origin), d = big(point.direction), L = big(origin_);
  const mpz_class height = dot(F.n, F.a - K), slope = dot(F.n, d);
  const BigVector X = slope * (K - L) + height * d;
  return slope > 0 ? target_from(X, slope) : target_from(BigVector{-X.x, -X.y, -X.z}, -slope);
}

// P, or its orthogonal projection P - (n . (P - a) / n . n) n.
Target View::target_of(const Vector& point, FaceId on_face) const {
  const BigVector P = big(point), L = big(origin_);
  if (on_face == kNoFace) return target_from(P - L, 1);
  const BigPlane F = big_plane(oracle_->mesh(), on_face);
  const mpz_class square = dot(F.n, F.n), height = dot(F.n, P - F.a);
  return target_from(square * (P - L) - height * F.n, square);
}

// Where a light's line to a point meets a face, it is looked for from the point.
bool View::is_there_before(FaceId face, const Holes::Point& point) const {
  return oracle_->is_there(face, point, {origin_.x - point[0], origin_.y - point[1], origin_.z - point[2]});
}

bool View::is_blocked(const SurfacePoint& point) const {
  const Target target = target_of(point);
  const Vector &K = point.origin, &d = point.direction;
  const Holes::Point place = Holes::crossing(point.vertices, {K.x, K.y, K.z}, {d.x, d.y, d.z});
  bool blocked = false;
  for_each_near(target, [&](std::size_t i) {
    bool strictly_inside = false;
    const FacePlanes& G = faces_[i];
    blocked = meets(G, target, &strictly_inside) && is_beyond(G, target) && is_there_before(G.face, place);
    return !blocked;
  });
  return blocked;
}

bool View::is_lit(const SurfacePoint& point) const {
  const BigPlane F = big_plane(point.vertices[0], point.vertices[1], point.vertices[2]);
  const int side_of_camera = sgn(dot(F.n, F.a - big(point.origin)));
  const int side_of_light = sgn(dot(F.n, F.a - big(origin_)));
  return side_of_camera * side_of_light > 0 && !is_blocked(point);
}

// (n . (P - a))^2 > tolerance^2 n . n
bool View::is_far_from_plane(FaceId face, const Vector& point, float tolerance) const {
  if (tolerance == 0) return true;
  const BigPlane G = big_plane(oracle_->mesh(), face);
  const mpz_class height = dot(G.n, big(point) - G.a), e = big(tolerance);
  return height * height > e * e * dot(G.n, G.n);
}

bool View::is_lit(const Vector& point, const facemap::PointLight::On& on) const {
  return is_reached(target_of(point, on.face), point, on.face, on.tolerance);
}

bool View::is_visible(const Vector& point, FaceId own, float tolerance) const {
  return is_reached(target_of(point, kNoFace), point, own, tolerance);
}

bool View::is_reached(const Target& target, const Vector& point, FaceId own, float tolerance) const {
  bool blocked = false;
  for_each_near(target, [&](std::size_t i) {
    const FacePlanes& G = faces_[i];
    bool strictly_inside = false;
    blocked = G.face != own && meets(G, target, &strictly_inside) && is_beyond(G, target) &&
              is_far_from_plane(G.face, point, tolerance) && is_there_before(G.face, {point.x, point.y, point.z});
    return !blocked;
  });
  return !blocked;
}

FaceId View::first_blocker(const Vector& point, FaceId skip) const {
  const Target target = target_of(point, kNoFace);
  const FacePlanes* first = nullptr;
  for_each_near(target, [&](std::size_t i) {
    const FacePlanes& G = faces_[i];
    bool strictly_inside = false;
    const bool is_blocker = G.face != skip && meets(G, target, &strictly_inside) && is_beyond(G, target) &&
                            is_there_before(G.face, {point.x, point.y, point.z});
    if (is_blocker && (first == nullptr || comes_before(G, *first, target))) first = &G;
    return true;
  });
  return first == nullptr ? kNoFace : first->face;
}

}  // namespace oracle
