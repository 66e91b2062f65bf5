#include "math/plain_signs.h"

#include <algorithm>
#include <cmath>

#include "math/expressions.h"
#include "math/numbers.h"

namespace facemap::plain {
namespace {

// The bounds. Written out, an expression is a sum of monomials, and each has gone through some r roundings on its way
// into the computed value: each multiplies it by 1 + delta, |delta| <= u = 2^-53. So |computed - true| is at most
// r u (1 + r u) times the sum of the monomials' magnitudes (Higham 2002, lemma 3.1), and that sum at most their number
// times the product of the largest components of their factors. A factor 1 + 2^-40 covers the second order, the
// rounding of those components and of the bound.
//
// No underflow to zero up to degree 6: inputs are multiples of 2^-149, so what is computed of degree k is one of
// 2^-149k. Degree 7 ends with a product; kUnderflow is more than that can lose, flush-to-zero included. Nothing
// overflows: 2^129 to the seventh power is 2^903.
constexpr double kUnit = 0x1p-53;
constexpr double kMargin = 1 + 0x1p-40;
constexpr double kUnderflow = 0x1p-1000;

// r roundings of `monomials` monomials.
constexpr double bound(int roundings, int monomials) { return roundings * monomials * kUnit * kMargin; }

using Vec = Vec3<double>;

constexpr PlainNumbers kNumbers;

double larger(double a, double b) { return a > b ? a : b; }

double largest(const Vec& v) { return larger(larger(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z)); }
double largest(const Vec& a, const Vec& b) { return larger(largest(a), largest(b)); }
double largest(const Vec& a, const Vec& b, const Vec& c) { return larger(largest(a, b), largest(c)); }

int sign_of(double value, double error) {
  if (value > error) return 1;
  return value < -error ? -1 : kUnknownSign;
}

// b - a, c - b, a - c: each edge from its corner to the next.
struct Edges {
  explicit Edges(const Triangle& f)
      : edges{kNumbers.difference(f[1], f[0]), kNumbers.difference(f[2], f[1]), kNumbers.difference(f[0], f[2])},
        size(largest(edges[0], edges[1], edges[2])) {}

  // 2 monomials a component; 4 roundings: two differences, their product, the subtraction.
  Vec normal() const { return cross(edges[2], edges[0]); }

  Vec edges[3];
  double size;
};

struct Corners {
  Corners(const Triangle& f, const Vector& O)
      : corners{kNumbers.difference(f[0], O), kNumbers.difference(f[1], O), kNumbers.difference(f[2], O)},
        size(largest(corners[0], corners[1], corners[2])) {}

  Vec corners[3];
  double size;
};

// Whether s ((a - O) x (b - a)) . d >= 0 for each edge, every one known to within `error`. Yes: all are positive.
Verdict within_edges(const Edges& edges, const Corners& corners, double s, const Vec& d, double error) {
  const auto edge_value = [&](int i) { return s * dot(cross(corners.corners[i], edges.edges[i]), d); };
  const double first = edge_value(0), second = edge_value(1), third = edge_value(2);
  if (first < -error || second < -error || third < -error) return Verdict::No;
  return first > error && second > error && third > error ? Verdict::Yes : Verdict::Unknown;
}

// w (P - base) for some w, and the most by which a component is off.
struct Offset {
  Vec value;
  double error;
};

// n . offset for n of 2 monomials a component after 4 roundings, below `size` each: the offset's error, and 7 roundings
// (n's, the product, two sums) of what is computed from it.
double error_of_product(double size, const Offset& offset) {
  return 6 * kMargin * size * (offset.error + bound(7, 1) * largest(offset.value)) + kUnderflow;
}

// Each kind of point says w (P - base) for any base, w > 0 after multiplication by `orientation`.
class RayPoint {
 public:
  explicit RayPoint(const TruePoint& p) : orientation(p.s > 0 ? 1 : -1) {
    const Edges edges(p.face);
    const Vec n = edges.normal(), to_face = kNumbers.difference(p.face[0], p.K), d = kNumbers.direction(p.d);
    point_ = {p.K, dot(n, d), dot(n, to_face) * d};
    error_ = bound(10, 6) * edges.size * edges.size * largest(d);
    to_face_ = largest(to_face);
  }

  // w: 6 monomials, 7 roundings; times the difference, itself rounded, and summed: 10. delta: 6 monomials, 8
  // roundings; times d and summed: 10.
  Offset from(const Vector& base) const {
    const Vec difference = kNumbers.difference(point_.anchor, base);
    return {point_.w * difference + point_.shift, error_ * (largest(difference) + to_face_)};
  }

  int orientation;

 private:
  RationalPoint<double, double> point_{};
  double error_, to_face_;
};

class ProjectedPoint {
 public:
  ProjectedPoint(const Vector& P, const Triangle& face) {
    const Edges edges(face);
    const Vec n = edges.normal(), to_face = kNumbers.difference(face[0], P);
    point_ = {P, dot(n, n), dot(n, to_face) * n};
    error_ = bound(14, 12) * edges.size * edges.size * edges.size * edges.size;
    to_face_ = largest(to_face);
  }

  // w: 12 monomials, 11 roundings; times the difference and summed: 14. The height: 6 monomials, 8 roundings; times
  // n's 2 monomials with 4 roundings, and summed: 12 monomials, 14 roundings.
  Offset from(const Vector& base) const {
    const Vec difference = kNumbers.difference(point_.anchor, base);
    return {point_.w * difference + point_.shift, error_ * (largest(difference) + to_face_)};
  }

  static constexpr int orientation = 1;

 private:
  RationalPoint<double, double> point_{};
  double error_, to_face_;
};

struct UserPoint {
  Offset from(const Vector& base) const {
    const Vec difference = kNumbers.difference(P, base);
    return {difference, bound(1, 1) * largest(difference)};
  }

  static constexpr int orientation = 1;
  Vector P;
};

// Strictly beyond G's plane, and within the cone of its three edges.
template <class Point>
Verdict blocks_point(const Triangle& G, int s_G, const Vector& L, const Point& point) {
  const double s = s_G * point.orientation;
  const Edges edges(G);
  const Offset from_plane = point.from(G[0]);
  const double height = s * dot(edges.normal(), from_plane.value);
  const double height_error = error_of_product(edges.size * edges.size, from_plane);
  if (height < -height_error) return Verdict::No;

  const Corners corners(G, L);
  const Offset offset = point.from(L);
  const double error = error_of_product(corners.size * edges.size, offset);
  const Verdict cone = within_edges(edges, corners, s, offset.value, error);
  return cone == Verdict::Yes && !(height > height_error) ? Verdict::Unknown : cone;
}

// (n . (P - a))^2: 36 monomials, 18 roundings. tolerance^2 n . n: 12 monomials, 14 roundings.
int tolerance_sign(const Triangle& G, const GivenPoint& p) {
  const Edges edges(G);
  const double size = edges.size * edges.size, distance = largest(kNumbers.difference(G[0], p.P)), e = p.tolerance;
  const double error = size * size * (bound(18, 36) * distance * distance + bound(14, 12) * e * e) + kUnderflow;
  return sign_of(outside_tolerance(kNumbers, G, p), error);
}

}  // namespace

// A component of n: 2 monomials, 4 roundings.
bool has_area(const Triangle& face) {
  const Edges edges(face);
  return largest(edges.normal()) > bound(4, 2) * edges.size * edges.size;
}

// n . (a - O): 6 monomials, 8 roundings.
int side(const Triangle& face, const Vector& O) {
  const Edges edges(face);
  const Vec a = kNumbers.difference(face[0], O);
  return sign_of(dot(edges.normal(), a), bound(8, 6) * edges.size * edges.size * largest(a));
}

// ((a - O) x (b - a)) . d: 6 monomials, 7 roundings.
Verdict covers(const Triangle& face, int s, const Vector& O, const Vector& d) {
  const Edges edges(face);
  const Corners corners(face, O);
  const Vec direction = kNumbers.direction(d);
  const double error = bound(7, 6) * corners.size * edges.size * largest(direction);
  return within_edges(edges, corners, s, direction, error);
}

// delta1 (n2 . d) - delta2 (n1 . d): 36 monomials each, 8 + 7 + 2 roundings.
int depth_difference(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& d) {
  const double size1 = Edges(face1).size, size2 = Edges(face2).size;
  const double distances = largest(kNumbers.difference(face1[0], O)) + largest(kNumbers.difference(face2[0], O));
  const double error = bound(17, 36) * (size1 * size1) * (size2 * size2) * distances * largest(kNumbers.direction(d));
  return sign_of(facemap::depth_difference(kNumbers, face1, face2, O, d), error);
}

Verdict blocks(const Triangle& G, int s_G, const Vector& L, const TruePoint& point) {
  return blocks_point(G, s_G, L, RayPoint(point));
}

Verdict blocks(const Triangle& G, int s_G, const Vector& L, const GivenPoint& point) {
  const Verdict verdict = point.on_face == nullptr ? blocks_point(G, s_G, L, UserPoint{point.P})
                                                   : blocks_point(G, s_G, L, ProjectedPoint(point.P, *point.on_face));
  if (verdict == Verdict::No || !(point.tolerance > 0)) return verdict;
  const int sign = tolerance_sign(G, point);
  if (sign == -1) return Verdict::No;
  return sign == 1 ? verdict : Verdict::Unknown;
}

// As side, for each corner.
Verdict reaches_beyond(const Triangle& F, const Triangle& G, int s_G) {
  const Edges edges(G);
  const Vec n = edges.normal();
  const double size = bound(8, 6) * edges.size * edges.size;
  Verdict verdict = Verdict::No;
  for (const Vector& corner : F) {
    const Vec to_plane = kNumbers.difference(G[0], corner);
    const int sign = sign_of(s_G * dot(n, to_plane), size * largest(to_plane));
    if (sign == -1) return Verdict::Yes;
    if (sign == kUnknownSign) verdict = Verdict::Unknown;
  }
  return verdict;
}

// delta and w: 6 monomials each, 8 and 7 roundings.
Tracked ray_parameter(const TruePoint& point) {
  const Edges edges(point.face);
  const Vec n = edges.normal(), to_face = kNumbers.difference(point.face[0], point.K);
  const Vec d = kNumbers.direction(point.d);
  const double size = edges.size * edges.size;
  return quotient(Tracked{dot(n, to_face), bound(8, 6) * size * largest(to_face)},
                  Tracked{dot(n, d), bound(7, 6) * size * largest(d)});
}

// Three components, each: the difference's rounding, t's error, the product's rounding and the sum's.
double offset(const Vector& L, const TruePoint& point, const Tracked& t, DVector* offset) {
  const Vec from_L = kNumbers.difference(point.K, L), d = kNumbers.direction(point.d);
  const Vec D = from_L + t.value * d;
  *offset = {D.x, D.y, D.z};
  return 3 * kMargin * (kUnit * (largest(from_L) + largest(D)) + largest(d) * (t.error + kUnit * std::fabs(t.value))) +
         kUnderflow;
}

}  // namespace facemap::plain
