#pragma once

#include "math/exact_sign.h"
#include "math/plain_bounds.h"

/// The points that predicates ask about in plain doubles, each with the error of its place.
namespace facemap::plain {

/// w (P - base) for some w, and the most by which a component is off.
struct Offset {
  Vec value;
  double error;
};

/// n . offset for n of 2 monomials a component after 4 roundings, below `size` each: the offset's error, and 7
/// roundings (n's, the product, two sums) of what is computed from it.
inline double error_of_product(double size, const Offset& offset) {
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

/// Sign of outside_tolerance (expressions.h).
// (n . (P - a))^2: 36 monomials, 18 roundings. tolerance^2 n . n: 12 monomials, 14 roundings.
inline int tolerance_sign(const Triangle& G, const GivenPoint& p) {
  const Edges edges(G);
  const double size = edges.size * edges.size, distance = largest(kNumbers.difference(G[0], p.P)), e = p.tolerance;
  const double error = size * size * (bound(18, 36) * distance * distance + bound(14, 12) * e * e) + kUnderflow;
  return sign_of(outside_tolerance(kNumbers, G, p), error);
}

/// Whether G blocks a given point, `blocks(P)` being the answer for P as one of the points above.
template <class Blocks>
Verdict blocks_given(const Triangle& G, const GivenPoint& point, const Blocks& blocks) {
  const Verdict verdict =
      point.on_face == nullptr ? blocks(UserPoint{point.P}) : blocks(ProjectedPoint(point.P, *point.on_face));
  if (verdict == Verdict::No || !(point.tolerance > 0)) return verdict;
  const int sign = tolerance_sign(G, point);
  if (sign == -1) return Verdict::No;
  return sign == 1 ? verdict : Verdict::Unknown;
}

}  // namespace facemap::plain
