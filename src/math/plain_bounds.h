#pragma once

#include <cmath>

#include "math/expressions.h"
#include "math/numbers.h"
#include "math/verdict.h"

/// Bounds of what plain doubles make of an expression, and the parts that the predicates on a face have in common.
namespace facemap::plain {

// The bounds. Written out, an expression is a sum of monomials, and each has gone through some r roundings on its way
// into the computed value: each multiplies it by 1 + delta, |delta| <= u = 2^-53. So |computed - true| is at most
// r u (1 + r u) times the sum of the monomials' magnitudes (Higham 2002, lemma 3.1), and that sum at most their number
// times the product of the largest components of their factors. A factor 1 + 2^-40 covers the second order, the
// rounding of those components and of the bound.
//
// No underflow to zero up to degree 6: inputs are multiples of 2^-149, so what is computed of degree k is one of
// 2^-149k. Degree 7 ends with a product; kUnderflow is more than that can lose, flush-to-zero included. Nothing
// overflows: 2^129 to the seventh power is 2^903.
inline constexpr double kUnit = 0x1p-53;
inline constexpr double kMargin = 1 + 0x1p-40;
inline constexpr double kUnderflow = 0x1p-1000;

/// r roundings of `monomials` monomials.
constexpr double bound(int roundings, int monomials) { return roundings * monomials * kUnit * kMargin; }

using Vec = Vec3<double>;

inline constexpr PlainNumbers kNumbers;

inline double larger(double a, double b) { return a > b ? a : b; }

inline double largest(const Vec& v) { return larger(larger(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z)); }
inline double largest(const Vec& a, const Vec& b) { return larger(largest(a), largest(b)); }
inline double largest(const Vec& a, const Vec& b, const Vec& c) { return larger(largest(a, b), largest(c)); }

inline int sign_of(double value, double error) {
  if (value > error) return 1;
  return value < -error ? -1 : kUnknownSign;
}

/// b - a, c - b, a - c: each edge from its corner to the next.
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

/// Whether s ((a - O) x (b - a)) . d >= 0 for each edge, every one known to within `error`. Yes: all are positive.
inline Verdict within_edges(const Edges& edges, const Corners& corners, double s, const Vec& d, double error) {
  const auto edge_value = [&](int i) { return s * dot(cross(corners.corners[i], edges.edges[i]), d); };
  const double first = edge_value(0), second = edge_value(1), third = edge_value(2);
  if (first < -error || second < -error || third < -error) return Verdict::No;
  return first > error && second > error && third > error ? Verdict::Yes : Verdict::Unknown;
}

}  // namespace facemap::plain
