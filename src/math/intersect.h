#pragma once

#include <facemap/vector.h>

#include <array>
#include <optional>

namespace facemap {

/// Where a ray meets a triangle: the point is origin + t direction = (1 - u - v) V0 + u V1 + v V2.
struct RayHit {
  double t;  ///< in lengths of the direction; above 0
  double u, v;
};

/// The paper's numeric test of a ray against a triangle, either side; Wang 2022, eq. (4) to (8). Edges and vertices
/// count as hit as far as rounding allows. None if the ray lies in the plane, if the triangle has no area, behind
/// the origin and at it (t = 0), and wherever an input is NaN. The direction may have any length.
/// Rounded, so never under an answer that is called exact: those come from exact_sign.h.
std::optional<RayHit> intersect(const DVector& origin, const DVector& direction,
                                const std::array<DVector, 3>& triangle);

}  // namespace facemap
