#include "math/plain_signs.h"

#include <cmath>

#include "math/expressions.h"
#include "math/numbers.h"
#include "math/plain_points.h"

namespace facemap::plain {
namespace {

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

// delta1 (n2 . d) - delta2 (n1 . d): 36 monomials each, 8 + 7 + 2 roundings for d as it is.
int depth_sign(const Triangle& face1, const Triangle& face2, const Vector& O, const Vec& d, double roundings) {
  const double size1 = Edges(face1).size, size2 = Edges(face2).size;
  const double distances = largest(kNumbers.difference(face1[0], O)) + largest(kNumbers.difference(face2[0], O));
  const double error = roundings * (size1 * size1) * (size2 * size2) * distances * largest(d);
  return sign_of(facemap::depth_difference(kNumbers, face1, face2, O, d), error);
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

int depth_difference(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& d) {
  return depth_sign(face1, face2, O, kNumbers.direction(d), bound(17, 36));
}

// P - O, itself rounded: 18.
int depth_difference_towards(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& P) {
  return depth_sign(face1, face2, O, kNumbers.difference(P, O), bound(18, 36));
}

Verdict blocks(const Triangle& G, int s_G, const Vector& L, const TruePoint& point) {
  return blocks_point(G, s_G, L, RayPoint(point));
}

Verdict blocks(const Triangle& G, int s_G, const Vector& L, const GivenPoint& point) {
  return blocks_given(G, point, [&](const auto& P) { return blocks_point(G, s_G, L, P); });
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

// 6 monomials, 8 roundings each.
Tracked segment_parameter(const Triangle& face, const Vector& O, const Vector& P) {
  const Edges edges(face);
  const Vec n = edges.normal(), to_face = kNumbers.difference(face[0], O), d = kNumbers.difference(P, O);
  const double size = bound(8, 6) * edges.size * edges.size;
  return quotient(Tracked{dot(n, to_face), size * largest(to_face)}, Tracked{dot(n, d), size * largest(d)});
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
