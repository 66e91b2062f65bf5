#include "math/intersect.h"

#include "math/dvector.h"

namespace facemap {

std::optional<RayHit> intersect(const DVector& origin, const DVector& direction,
                                const std::array<DVector, 3>& triangle) {
  // Wang 2022, eq. (4): O + D t = (1 - u - v) V0 + u V1 + v V2. With the letters of eq. (6) it is the linear system
  // [-D E1 E2] (t, u, v) = T, eq. (5), (6).
  const DVector& D = direction;
  const DVector E1 = triangle[1] - triangle[0];
  const DVector E2 = triangle[2] - triangle[0];
  const DVector T = origin - triangle[0];

  // Wang 2022, eq. (7), shared products as in eq. (8).
  const DVector R = cross(D, E2);
  const DVector Q = cross(T, E1);
  // Departs: eq. (7), (8) divide by |R . E1|. Where R . E1 < 0 (the ray runs along E1 x E2, not against it) that
  // turns the signs of t, u and v and loses the hit. To see one side alone is a decision of its own, not made here.
  const double determinant = dot(R, E1);
  const double t = dot(Q, E2) / determinant;
  const double u = dot(R, T) / determinant;
  const double v = dot(Q, D) / determinant;

  // Each condition is false for NaN, so a zero determinant (0/0, or an infinite u or v) is no hit.
  // Departs: eq. (4) sets no bound on t; a ray has none of the points behind its origin.
  const bool inside = u >= 0 && v >= 0 && u + v <= 1;
  if (inside && t > 0) return RayHit{t, u, v};
  return std::nullopt;
}

}  // namespace facemap
