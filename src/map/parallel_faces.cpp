#include "map/parallel_faces.h"

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/parallel_signs.h"
#include "math/power_of_two.h"
#include "scene/reserve_pages.h"

namespace facemap {
namespace {

// Of float32, in units of 2^-24 of the sum of the terms' magnitudes: factor, coordinate and product, one each, and
// three sums. The constant is no larger than the sum of the others, as corners lie in the raster; 16 holds both, and
// the rounding of this bound.
constexpr double kFloatRoundings = 16 * 0x1p-24;

// Of doubles, relative to the raster's extent and to the length of an edge, or to the product of two for the plane: the
// factors' own rounding (2^-48 an edge, 2^-46 a normal) times an offset of up to twice the extent a coordinate, and the
// corner's place, off by 2^-48.
constexpr double kDoubleError = 0x1p-42;

// A bound that no value exceeds.
constexpr double kUseless = 0x1p70;

}  // namespace

ParallelFaces::ParallelFaces(const Scene& scene, const Vector& direction, const ParallelFrame& frame)
    : frame_(frame), sides_(scene.face_count()) {
  reserve_pages(faces_, scene.face_count());  // read in no order
  faces_.resize(scene.face_count());
  for (const std::uint32_t id : scene.kept_faces()) {
    const Triangle face = triangle_of(scene, id);
    const int s = side_along(face, direction);
    sides_[id] = static_cast<std::int8_t>(s);
    if (s != 0) faces_[id] = face_of({face[0], face[1], face[2]}, s);
  }
}

ParallelFaces::Face ParallelFaces::face_of(const Vector (&corners)[3], int side) const {
  const double scale = frame_.scale(), extent = frame_.extent() * scale, asked_error = frame_.allowed_error() * scale;
  DVector at[3], along[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = frame_.local(DVector(corners[k]) - DVector(frame_.origin())) * scale;
    along[k] = frame_.local(DVector(corners[(k + 1) % 3]) - DVector(corners[k])) * scale;
  }
  Face face;
  double edge_error = 0;
  for (int k = 0; k < 3; ++k) {
    // s det(a - P, b - P, d), which is -s |d| times the flat cross product of b - a and P - a: the frame is
    // left-handed.
    const double x = side * along[k].y, y = -side * along[k].x;
    const double factor = inverse_power_of_two(std::max(std::fabs(x), std::fabs(y)));
    face.x[k] = static_cast<float>(x * factor);
    face.y[k] = static_cast<float>(y * factor);
    face.c[k] = static_cast<float>(-(x * at[k].x + y * at[k].y) * factor);
    const double per_step = std::fabs(x) + std::fabs(y);
    edge_error = std::max(edge_error, factor * (per_step * (extent * kFloatRoundings + asked_error) +
                                                length(along[k]) * extent * kDoubleError));
  }
  face.edge_error = float_above(std::min(edge_error, kUseless));

  // s n . (P - a).
  const DVector v = frame_.local(DVector(corners[2]) - DVector(corners[0])) * scale;
  const DVector n = cross(along[0], v) * static_cast<double>(-side);
  const double factor = inverse_power_of_two(std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)}));
  face.x[3] = static_cast<float>(n.x * factor);
  face.y[3] = static_cast<float>(n.y * factor);
  face.z = static_cast<float>(n.z * factor);
  face.c[3] = static_cast<float>(-dot(n, at[0]) * factor);
  const double per_step = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
  const double plane_error = factor * (per_step * (extent * kFloatRoundings + asked_error) +
                                       length(along[0]) * length(v) * extent * kDoubleError);
  face.plane_error = float_above(std::min(plane_error, kUseless));

  const double depth = std::min({at[0].z, at[1].z, at[2].z}) / scale;
  face.nearest = std::max(0.0f, float_below(frame_.depth(depth)));
  return face;
}

ParallelFaces::Asked ParallelFaces::asked(const ParallelFrame::Place& place) const {
  const DVector p = place.at * frame_.scale();
  const double z = std::clamp(place.at.z, frame_.front(), frame_.back()) * frame_.scale();
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(z)};
}

ParallelFaces::Sides ParallelFaces::sides(const Face& face, const Asked& asked) {
  float value[4];
  for (int k = 0; k < 4; ++k) value[k] = face.x[k] * asked.x + face.y[k] * asked.y;
  for (int k = 0; k < 4; ++k) value[k] += face.c[k];
  const float height = value[3] + face.z * asked.z;
  const float least = std::min({value[0], value[1], value[2]});
  const int beyond = height > face.plane_error ? 1 : height < -face.plane_error ? -1 : 0;
  const bool surely_outside = -face.edge_error > least, surely_inside = least > face.edge_error;
  return {surely_outside, surely_inside, beyond};
}

}  // namespace facemap
