#pragma once

#include <facemap/counters.h>

#include "math/exact_sign.h"
#include "math/expressions.h"
#include "math/numbers.h"

/// The parts of the last stage of the predicates: which inputs an expression has, and answers made of exact signs.
namespace facemap {

inline ExponentRange lengths_of(const Triangle& f, const Vector& O) { return ExponentRange::of(f[0], f[1], f[2], O); }

inline ExponentRange lengths_of(const Triangle& f, const Triangle& g, const Vector& O) {
  ExponentRange range = lengths_of(f, O);
  for (const Vector& corner : g) range.include(corner);
  return range;
}

inline ExponentRange lengths_of(const TruePoint& p, const Vector& L) {
  return ExponentRange::of(p.face[0], p.face[1], p.face[2], p.K, L);
}

inline ExponentRange lengths_of(const GivenPoint& p, const Vector& L) {
  ExponentRange range = ExponentRange::of(p.P, L);
  if (p.on_face != nullptr) {
    for (const Vector& corner : *p.on_face) range.include(corner);
  }
  range.include(p.tolerance);
  return range;
}

template <class Point>
ExponentRange lengths_of(const Triangle& G, const Point& p, const Vector& L) {
  ExponentRange range = lengths_of(p, L);
  for (const Vector& corner : G) range.include(corner);
  return range;
}

inline ExponentRange directions_of(const TruePoint& p) { return ExponentRange::of(p.d); }
inline ExponentRange directions_of(const GivenPoint&) { return ExponentRange::of(); }

inline void count_stage(bool in_double, Counters* counters) {
  if (counters != nullptr) ++(in_double ? counters->by_double : counters->by_exact);
}

/// Whether s det(a - O, b - O, d) >= 0 for each edge; clears `strictly_inside` where one is 0.
template <class Numbers, class T>
bool is_within_edges(const Numbers& numbers, const Triangle& f, int s, const Vector& O, const Vec3<T>& d,
                     bool* strictly_inside) {
  for (int i = 0; i < 3; ++i) {
    const int sign = edge(numbers, f[i], f[(i + 1) % 3], O, d).sign();
    if (s * sign < 0) return false;
    if (sign == 0) *strictly_inside = false;
  }
  return true;
}

/// Whether G blocks a point: is_behind(P, s) for P as a rational point and s the side of G times the sign of P's w.
template <class Numbers, class IsBehind>
bool blocks_rational(const Numbers& numbers, const Triangle&, int s_G, const TruePoint& p, const IsBehind& is_behind) {
  return is_behind(point_on_ray(numbers, p), p.s > 0 ? s_G : -s_G);
}

template <class Numbers, class IsBehind>
bool blocks_rational(const Numbers& numbers, const Triangle& G, int s_G, const GivenPoint& p,
                     const IsBehind& is_behind) {
  if (p.tolerance > 0 && outside_tolerance(numbers, G, p).sign() <= 0) return false;
  if (p.on_face == nullptr) return is_behind(FloatPoint{p.P}, s_G);
  return is_behind(projected_point(numbers, p.P, *p.on_face), s_G);
}

}  // namespace facemap
