#include "support/parallel_oracle.h"

#include <algorithm>
#include <cmath>

namespace oracle {
namespace {

using Corners = std::array<Vector, 3>;

constexpr int kUnsure = 2;

// A point seen along d: (p_i d_k - p_k d_i, p_j d_k - p_k d_j), i, j, k in cyclic order. Along d both are constant.
struct Flat {
  mpz_class x, y;
};

const mpz_class& component(const BigVector& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Flat flat(const BigVector& p, const BigVector& d, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  return {component(p, i) * component(d, k) - component(p, k) * component(d, i),
          component(p, j) * component(d, k) - component(p, k) * component(d, j)};
}

mpz_class area(const Flat& a, const Flat& b) { return a.x * b.y - a.y * b.x; }

Flat minus(const Flat& a, const Flat& b) { return {a.x - b.x, a.y - b.y}; }

int longest_axis(const Vector& d) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(d[i]) > std::fabs(d[axis])) axis = i;
  }
  return axis;
}

double largest(const std::array<double, 3>& v) { return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])}); }

// All doubles below are products of at most five numbers in this range, or 0: they neither overflow nor vanish.
bool is_in_range(double x) { return x == 0 || (x > 0x1p-160 && x < 0x1p160); }

int sign_beyond(double value, double bound) {
  if (value > bound) return 1;
  return value < -bound ? -1 : kUnsure;
}

Place place_at(const BigVector& X, const mpz_class& w) {
  return {X, w, {rounded_quotient(X.x, w), rounded_quotient(X.y, w), rounded_quotient(X.z, w)}};
}

}  // namespace

Place place_of(const Vector& P) { return {big(P), 1, {P.x, P.y, P.z}}; }

// P = K + t d, where det(a - K, u, v) = t det(d, u, v) for the sides u, v of the face.
Place place_of(const SurfacePoint& point) {
  const BigVector a = big(point.vertices[0]), u = big(point.vertices[1]) - a, v = big(point.vertices[2]) - a;
  const BigVector K = big(point.origin), d = big(point.direction);
  const mpz_class numerator = dot(cross(a - K, u), v), denominator = dot(cross(d, u), v);
  const BigVector X = denominator * K + numerator * d;
  return denominator > 0 ? place_at(X, denominator) : place_at(mpz_class(-1) * X, -denominator);
}

// a + (p u + q v) / D, from the normal equations of |P - a - p u - q v|.
Place place_on(const Corners& face, const Vector& P) {
  const BigVector a = big(face[0]), u = big(face[1]) - a, v = big(face[2]) - a, r = big(P) - a;
  const mpz_class uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), ru = dot(r, u), rv = dot(r, v);
  const mpz_class D = uu * vv - uv * uv, p = ru * vv - rv * uv, q = rv * uu - ru * uv;
  return place_at(D * a + p * u + q * v, D);
}

// ---- one face -------------------------------------------------------------------------------------------

ParallelFace::ParallelFace(const Corners& corners, const Vector& d)
    : corners_(corners), d_(d), axis_(longest_axis(d)), side_(0), turn_(0) {
  const BigVector direction = big(d);
  const Flat a = flat(big(corners[0]), direction, axis_), b = flat(big(corners[1]), direction, axis_),
             c = flat(big(corners[2]), direction, axis_);
  // Written out, the area is d_k times n . d.
  turn_ = sgn(area(minus(b, a), minus(c, a)));
  side_ = turn_ * sgn(component(direction, axis_));
}

// e_0 belongs to corner 0 and is the area of P, corner 1, corner 2.
ParallelFace::Weights ParallelFace::weigh(const Place& P) const {
  const BigVector d = big(d_);
  std::array<Flat, 3> q;
  std::array<mpz_class, 3> ahead;
  for (int i = 0; i < 3; ++i) {
    const BigVector from_P = P.w * big(corners_[i]) - P.X;
    q[i] = flat(from_P, d, axis_);
    ahead[i] = dot(d, from_P);
  }
  Weights weights;
  weights.sum = weights.height = 0;
  for (int i = 0; i < 3; ++i) {
    weights.e[i] = turn_ * area(q[(i + 1) % 3], q[(i + 2) % 3]);
    weights.sum += weights.e[i];
    weights.height += weights.e[i] * ahead[i];
  }
  return weights;
}

// Let Q be the largest component of a corner - P, off by at most delta = 2^-49 (|corner| + |P|): P is rounded to 2^-50,
// the difference by 2^-53. A flat coordinate is two products with |d| <= D: at most 2 Q D, off by D eta with
// eta = 2 delta + 2^-49 Q. An area is two products of those: at most 8 Q^2 D^2, off by
// 8 Q D^2 eta + 2 D^2 eta^2 + 24 x 2^-53 Q^2 D^2 <= 12 Q D^2 eta if eta <= Q. d . q is at most 3 Q D, off by
// 4 D eta. Three areas times those are off by 3 (12 x 3 + 8 x 4 + 12 x 4) Q^2 D^3 eta and some roundings: less than
// 512 Q^2 D^3 eta.
bool ParallelFace::meet_in_doubles(const Place& P, Meeting* meeting) const {
  const std::array<double, 3> d{d_.x, d_.y, d_.z};
  std::array<std::array<double, 3>, 3> q;
  double Q = 0, size = largest(P.rounded);
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) q[i][axis] = double(corners_[i][axis]) - P.rounded[axis];
    Q = std::max(Q, largest(q[i]));
    size = std::max(size, largest({corners_[i].x, corners_[i].y, corners_[i].z}));
  }
  const double D = largest(d), eta = 0x1p-48 * 2 * size + 0x1p-49 * Q;
  const bool is_known = std::isfinite(P.rounded[0] + P.rounded[1] + P.rounded[2]);
  if (!is_known || !(eta <= Q) || !is_in_range(Q) || !is_in_range(D) || !is_in_range(size)) return false;
  const int k = axis_, i = (k + 1) % 3, j = (k + 2) % 3;
  std::array<std::array<double, 2>, 3> at;
  for (int c = 0; c < 3; ++c) at[c] = {q[c][i] * d[k] - q[c][k] * d[i], q[c][j] * d[k] - q[c][k] * d[j]};
  const double area_bound = 16 * Q * D * D * eta;
  double height = 0;
  bool is_sure = true;
  for (int c = 0; c < 3; ++c) {
    const auto &a = at[(c + 1) % 3], &b = at[(c + 2) % 3];
    const double e = turn_ * (a[0] * b[1] - a[1] * b[0]);
    const int sign = sign_beyond(e, area_bound);
    if (sign == -1) {
      *meeting = {};
      return true;
    }
    is_sure = is_sure && sign == 1;
    height += e * (d[0] * q[c][0] + d[1] * q[c][1] + d[2] * q[c][2]);
  }
  const int where = sign_beyond(height, 512 * Q * Q * D * D * D * eta);
  *meeting = {true, true, where};
  return is_sure && where != kUnsure;
}

ParallelFace::Meeting ParallelFace::meet(const Place& P, bool use_doubles) const {
  if (side_ == 0) return {};
  Meeting meeting;
  if (use_doubles && meet_in_doubles(P, &meeting)) return meeting;
  const Weights weights = weigh(P);
  for (const mpz_class& e : weights.e) {
    if (e < 0) return {};
  }
  const auto is_positive = [](const mpz_class& e) { return e > 0; };
  return {true, std::all_of(weights.e.begin(), weights.e.end(), is_positive), sgn(weights.height)};
}

int ParallelFace::compare(const ParallelFace& f, const ParallelFace& g, const Place& P) {
  const Weights a = f.weigh(P), b = g.weigh(P);
  return sgn(mpz_class(a.height * b.sum - b.height * a.sum));
}

// The volume of u, v and P - a, squared, beside the squared area times tolerance^2 (Lagrange's identity).
bool ParallelFace::is_far(const Corners& corners, const Vector& P, float tolerance) {
  if (!(tolerance > 0)) return true;
  const BigVector a = big(corners[0]), u = big(corners[1]) - a, v = big(corners[2]) - a;
  const mpz_class volume = dot(cross(u, v), big(P) - a), e = big(tolerance), uv = dot(u, v);
  return volume * volume > e * e * (dot(u, u) * dot(v, v) - uv * uv);
}

// ---- a mesh ---------------------------------------------------------------------------------------------

ParallelView::ParallelView(const Oracle& oracle, const Vector& d) : oracle_(&oracle), d_(d) {
  const Mesh& mesh = oracle.mesh();
  for (const FaceId id : oracle.kept_faces()) {
    const Corners corners{mesh.vertex(id, 0), mesh.vertex(id, 1), mesh.vertex(id, 2)};
    faces_.push_back({id, corners, ParallelFace(corners, d)});
  }
}

int ParallelView::side(FaceId face) const {
  const auto found = std::find_if(faces_.begin(), faces_.end(), [face](const KeptFace& f) { return f.id == face; });
  return found == faces_.end() ? 0 : found->face.side();
}

Hit ParallelView::nearest(const Vector& ray_origin) const {
  const Place O = place_of(ray_origin);
  const KeptFace* best = nullptr;
  Hit hit;
  for (const KeptFace& f : faces_) {
    const ParallelFace::Meeting meeting = f.face.meet(O);
    if (!meeting.is_met || meeting.where <= 0 || !is_there(f.id, ray_origin)) continue;
    const int order = best == nullptr ? -1 : ParallelFace::compare(f.face, best->face, O);
    const bool is_tied = order == 0 || (order > 0 && hit.tied);
    // Faces come in order of id: among equals only one turned towards the camera displaces one turned away.
    if (order < 0 || (order == 0 && f.face.side() < 0 && hit.side > 0)) {
      best = &f;
      hit = {f.id, meeting.strictly_inside, false, f.face.side()};
    }
    hit.tied = is_tied;
  }
  return hit;
}

bool ParallelView::is_there(FaceId face, const Vector& P) const {
  return oracle_->is_there(face, {P.x, P.y, P.z}, {d_.x, d_.y, d_.z});
}

bool ParallelView::is_blocked(const Place& P, FaceId skipped) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const KeptFace& f) {
    const ParallelFace::Meeting meeting = f.face.meet(P);
    return f.id != skipped && meeting.is_met && meeting.where < 0;
  });
}

bool ParallelView::is_lit(const SurfacePoint& point) const {
  const BigVector a = big(point.vertices[0]), u = big(point.vertices[1]) - a, v = big(point.vertices[2]) - a;
  const int side_of_camera = sgn(dot(cross(a - big(point.origin), u), v));
  const int side_of_light = ParallelFace(point.vertices, d_).side();
  if (side_of_camera * side_of_light <= 0) return false;
  const Place place = place_of(point);
  const Vector &K = point.origin, &d = point.direction;
  const Holes::Point seen = Holes::crossing(point.vertices, {K.x, K.y, K.z}, {d.x, d.y, d.z});
  return std::none_of(faces_.begin(), faces_.end(), [&](const KeptFace& f) {
    const ParallelFace::Meeting meeting = f.face.meet(place);
    return meeting.is_met && meeting.where < 0 && oracle_->is_there(f.id, seen, {d_.x, d_.y, d_.z});
  });
}

bool ParallelView::is_lit(const Vector& P, const facemap::PointLight::On& on) const {
  const auto found = std::find_if(faces_.begin(), faces_.end(), [&](const KeptFace& f) { return f.id == on.face; });
  const Place place = found == faces_.end() ? place_of(P) : place_on(found->corners, P);
  return std::none_of(faces_.begin(), faces_.end(), [&](const KeptFace& f) {
    const ParallelFace::Meeting meeting = f.face.meet(place);
    return f.id != on.face && meeting.is_met && meeting.where < 0 && ParallelFace::is_far(f.corners, P, on.tolerance) &&
           is_there(f.id, P);
  });
}

}  // namespace oracle
