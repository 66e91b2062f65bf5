#include "math/plain_parallel_signs.h"

#include "math/plain_bounds.h"
#include "math/plain_points.h"

namespace facemap::plain {
namespace {

// Whether s ((b - a) x w (P - a)) . d >= 0 for each edge. Apart from the offset's error it is as a product with a
// normal: 2 monomials a component, and 6 roundings of what is computed from the offset: the edge's, two products, the
// subtraction, two sums.
template <class Point>
Verdict within_edges_along(const Triangle& G, const Edges& edges, double s, const Vec& d, const Point& point) {
  const double size = edges.size * largest(d);
  Verdict verdict = Verdict::Yes;
  for (int i = 0; i < 3; ++i) {
    const Offset from_corner = point.from(G[i]);
    const double value = s * dot(cross(edges.edges[i], from_corner.value), d);
    const double error = error_of_product(size, from_corner);
    if (value < -error) return Verdict::No;
    if (!(value > error)) verdict = Verdict::Unknown;
  }
  return verdict;
}

// Strictly beyond G's plane, and on the inner side of its three edges.
template <class Point>
Verdict blocks_point_along(const Triangle& G, int s_G, const Vector& d, const Point& point) {
  const double s = s_G * point.orientation;
  const Edges edges(G);
  const Offset from_plane = point.from(G[0]);
  const double height = s * dot(edges.normal(), from_plane.value);
  const double error = error_of_product(edges.size * edges.size, from_plane);
  if (height < -error) return Verdict::No;
  const Verdict within = within_edges_along(G, edges, s, kNumbers.direction(d), point);
  return within == Verdict::Yes && !(height > error) ? Verdict::Unknown : within;
}

}  // namespace

// n . d: 6 monomials, 7 roundings.
int side_along(const Triangle& face, const Vector& d) {
  const Edges edges(face);
  const Vec direction = kNumbers.direction(d);
  return sign_of(dot(edges.normal(), direction), bound(7, 6) * edges.size * edges.size * largest(direction));
}

// n . (a - O): as side, 6 monomials, 8 roundings. The edges: as covers, 6 monomials, 7 roundings.
Verdict covers_along(const Triangle& face, int s, const Vector& O, const Vector& d) {
  const Edges edges(face);
  const Corners corners(face, O);
  const double ahead = s * dot(edges.normal(), corners.corners[0]);
  const double ahead_error = bound(8, 6) * edges.size * edges.size * corners.size;
  if (ahead < -ahead_error) return Verdict::No;
  const Vec direction = kNumbers.direction(d);
  const double error = bound(7, 6) * corners.size * edges.size * largest(direction);
  const Verdict within = within_edges(edges, corners, s, direction, error);
  return within == Verdict::Yes && !(ahead > ahead_error) ? Verdict::Unknown : within;
}

Verdict blocks_along(const Triangle& G, int s_G, const Vector& d, const TruePoint& point) {
  return blocks_point_along(G, s_G, d, RayPoint(point));
}

Verdict blocks_along(const Triangle& G, int s_G, const Vector& d, const GivenPoint& point) {
  return blocks_given(G, point, [&](const auto& P) { return blocks_point_along(G, s_G, d, P); });
}

}  // namespace facemap::plain
