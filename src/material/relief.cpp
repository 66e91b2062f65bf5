#include "material/relief.h"

#include "math/dvector.h"

namespace facemap {

ImageAxes::ImageAxes(const FaceCorners& face, const TexturePoint (&places)[3]) {
  const DVector a = face.v[1] - face.v[0], b = face.v[2] - face.v[0];
  const TexturePoint p = places[1] - places[0], q = places[2] - places[0];
  const double turn = p.x * q.y - p.y * q.x;
  if (turn == 0 || !std::isfinite(turn)) return;
  const double sign = turn > 0 ? 1 : -1;
  right = normalized((a * q.y - b * p.y) * sign);
  up = normalized((a * q.x - b * p.x) * sign);
}

DVector tilted(const DVector& normal, const ImageAxes& axes, const DVector& local, bool is_behind) {
  const DVector right = normalized(axes.right - normal * dot(normal, axes.right));
  if (right == DVector(0)) return normal;
  const DVector side = cross(normal, right);
  const DVector up = dot(side, axes.up) < 0 ? -side : side;
  const double sign = is_behind ? -1 : 1;
  const DVector tilt = normalized(right * (sign * local.x) + up * (sign * local.y) + normal * local.z);
  return tilt == DVector(0) ? normal : tilt;
}

}  // namespace facemap
