#pragma once

#include "math/exact_sign.h"
#include "math/vec3.h"

/// The expressions behind the predicates, written once for every kind of numbers (numbers.h). Letters as in
/// exact_sign.h.
namespace facemap {

/// n = (b - a) x (c - a), from the vertices themselves: never a x b about the origin, whose factors are nearly
/// parallel.
template <class Numbers>
auto normal(const Numbers& numbers, const Triangle& f) {
  return cross(numbers.difference(f[1], f[0]), numbers.difference(f[2], f[0]));
}

/// det(a - O, b - O, c - O) = n . (a - O)
template <class Numbers, class T>
auto determinant(const Numbers& numbers, const Triangle& f, const Vec3<T>& n, const Vector& O) {
  return dot(n, numbers.difference(f[0], O));
}

/// det(a - O, b - O, d) = ((a - O) x (b - a)) . d
template <class Numbers, class T>
auto edge(const Numbers& numbers, const Vector& a, const Vector& b, const Vector& O, const Vec3<T>& d) {
  return dot(cross(numbers.difference(a, O), numbers.difference(b, a)), d);
}

/// t1 - t2 times the positive s1 s2 (n1 . d) (n2 . d), but for that sign; d is a direction or a difference of points.
template <class Numbers, class T>
auto depth_difference(const Numbers& numbers, const Triangle& f1, const Triangle& f2, const Vector& O,
                      const Vec3<T>& d) {
  const auto n1 = normal(numbers, f1), n2 = normal(numbers, f2);
  return determinant(numbers, f1, n1, O) * dot(n2, d) - determinant(numbers, f2, n2, O) * dot(n1, d);
}

/// A point P as a rational one: w (P - base) = w (anchor - base) + shift, for any base. The sign of w is known.
template <class W, class S>
struct RationalPoint {
  Vector anchor;
  W w;
  Vec3<S> shift;

  template <class Numbers>
  auto from(const Numbers& numbers, const Vector& base) const {
    return w * numbers.difference(anchor, base) + shift;
  }
};

template <class W, class S>
RationalPoint(Vector, W, Vec3<S>) -> RationalPoint<W, S>;

/// A float32 point.
struct FloatPoint {
  Vector anchor;

  template <class Numbers>
  auto from(const Numbers& numbers, const Vector& base) const {
    return numbers.difference(anchor, base);
  }
};

/// P = K + (delta / w) d with w = n . d, delta = n . (a - K): a ray that hits its face has s w > 0.
template <class Numbers>
auto point_on_ray(const Numbers& numbers, const TruePoint& p) {
  const auto n = normal(numbers, p.face);
  const auto d = numbers.direction(p.d);
  const auto w = dot(n, d);
  return RationalPoint{p.K, w, determinant(numbers, p.face, n, p.K) * d};
}

/// The orthogonal projection of P onto the plane of a face: P - (n . (P - a) / w) n, w = n . n > 0.
template <class Numbers>
auto projected_point(const Numbers& numbers, const Vector& P, const Triangle& face) {
  const auto n = normal(numbers, face);
  const auto minus_height = determinant(numbers, face, n, P);
  return RationalPoint{P, dot(n, n), minus_height * n};
}

/// w det(a - P, b - P, d) = ((b - a) x w (P - a)) . d, for a point as above.
template <class Numbers, class Point, class T>
auto edge_along(const Numbers& numbers, const Vector& a, const Vector& b, const Point& point, const Vec3<T>& d) {
  return dot(cross(numbers.difference(b, a), point.from(numbers, a)), d);
}

/// How far P is from G's plane beyond the tolerance: (n . (P - a))^2 - tolerance^2 n . n
template <class Numbers>
auto outside_tolerance(const Numbers& numbers, const Triangle& G, const GivenPoint& p) {
  const auto n = normal(numbers, G);
  const auto height = determinant(numbers, G, n, p.P);
  const auto e = numbers.length(p.tolerance);
  return height * height - e * e * dot(n, n);
}

}  // namespace facemap
