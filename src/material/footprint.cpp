#include "material/footprint.h"

namespace facemap {
namespace {

// A value that the footprint takes where it has no bound: the mean of the texture, whatever its size.
constexpr double kEverywhere = 1e9;

double bounded(double x) { return std::fabs(x) < kEverywhere ? x : kEverywhere; }  // NaN too

TexturePoint bounded(const TexturePoint& move) { return {bounded(move.x), bounded(move.y)}; }

// How the point t d of the plane moves if the direction does.
DVector move_on_plane(const DVector& n, const DVector& d, double t, const DVector& change) {
  return (change - d * (dot(n, change) / dot(n, d))) * t;
}

}  // namespace

CoordinateGradient::CoordinateGradient(const FaceCorners& face, const CornerCoordinates& coordinates) {
  const double squared = dot(face.n, face.n);
  if (!(squared > 0)) return;
  const auto& v = face.v;
  // The weights of barycentric() are linear in the point: dot(n, cross(e, p)) = dot(cross(n, e), p).
  const DVector weights[3] = {cross(face.n, v[2] - v[1]), cross(face.n, v[0] - v[2]), cross(face.n, v[1] - v[0])};
  for (int i = 0; i < 3; ++i) {
    u_ += weights[i] * coordinates.uv[i].x;
    v_ += weights[i] * coordinates.uv[i].y;
  }
  u_ *= 1 / squared;
  v_ *= 1 / squared;
}

Footprint footprint_of(const FaceCorners& face, const CoordinateGradient& gradient, const DVector& K,
                       const RayBundle& rays) {
  const DVector d(rays.through);
  const double t = dot(face.n, face.v[0] - K) / dot(face.n, d);
  const auto move = [&](const Vector& neighbour) {
    return bounded(gradient.at(move_on_plane(face.n, d, t, DVector(neighbour) - d)));
  };
  return {move(rays.right), move(rays.down)};
}

}  // namespace facemap
