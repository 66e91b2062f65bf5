#pragma once

#include <facemap/vector.h>

#include <glm/mat4x4.hpp>

namespace facemap {

/// Camera space to pixels. Row vectors as in the paper: (x, y, z, 1) M S, then division by the fourth component.
/// Camera space: x right, y up, z along the sight.

/// Wang 2022, eq. (1). `field_angle` is the full vertical angle of view in radians, `aspect` width / height,
/// 0 < near < far. After the division x and y are in -1..1 inside the picture, z is 0 at the near plane and 1 at the
/// far one.
glm::dmat4 perspective_matrix(double field_angle, double aspect, double near, double far);

/// Wang 2022, eq. (2): x and y to pixels, y downwards.
glm::dmat4 screen_matrix(int width, int height);

/// A point of camera space with z > 0: its pixel coordinates and its depth in 0..1.
DVector screen_from_local(const DVector& local, const glm::dmat4& MS);

/// The distance along the sight that has `depth`, the inverse of eq. (1)'s third column.
double sight_distance(double depth, double near, double far);

}  // namespace facemap
