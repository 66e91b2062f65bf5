#include "scene/generators/bust_figure.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "scene/generators/sculpt.h"

namespace facemap::generators {
namespace {

// The figure is symmetric: every part below is given for x >= 0, and asked at (|x|, y, z).

double skull_and_jaw(const DVector& p) {
  double d = ellipsoid(p, {0, 0.25, -0.12}, {0.72, 0.82, 0.90});
  d = joined(d, ellipsoid(p, {0, -0.35, 0.22}, {0.57, 0.76, 0.62}), 0.20);
  d = joined(d, limb(p, {0.40, -0.60, 0.0}, 0.13, {0.12, -0.99, 0.62}, 0.15), 0.20);  // jaw
  d = joined(d, ball(p, {0, -1.0, 0.70}, 0.155), 0.12);                               // chin
  d = joined(d, ellipsoid(p, {0.38, -0.27, 0.49}, {0.20, 0.15, 0.20}), 0.25);         // cheek bone
  d = joined(d, ellipsoid(p, {0, -0.66, 0.60}, {0.33, 0.27, 0.27}), 0.18);            // around the teeth
  return d;
}

double brow_and_sockets(double d, const DVector& p) {
  d = joined(d, limb(p, {0.12, 0.17, 0.76}, 0.055, {0.46, 0.20, 0.59}, 0.05), 0.16);
  return carved(d, ellipsoid(p, {0.30, -0.01, 0.83}, {0.205, 0.125, 0.175}), 0.10);
}

double eye(double d, const DVector& p) {
  const DVector centre(0.300, -0.02, 0.560);
  const DVector q = p - centre;
  // The opening between the lids is an almond; the lids are a thicker ball around the eyeball without it.
  const double across = (q.x + 0.005) / 0.178, middle = 0.05 * q.x;
  const double half = (q.y > middle ? 0.084 : 0.052) * (1 - across * across);
  const double opening = half - std::abs(q.y - middle);
  const double lids = common(ball(p, centre, 0.194), opening, 0.03);
  return std::min(joined(d, lids, 0.07), ball(p, centre, 0.169));
}

double nose(double d, const DVector& p) {
  d = joined(d, limb(p, {0, 0.10, 0.77}, 0.050, {0, -0.38, 0.995}, 0.068), 0.10);
  d = joined(d, ellipsoid(p, {0, -0.34, 0.85}, {0.085, 0.20, 0.17}), 0.08);
  d = joined(d, ball(p, {0, -0.395, 1.01}, 0.073), 0.05);
  d = joined(d, ball(p, {0.084, -0.435, 0.90}, 0.056), 0.05);
  return carved(d, limb(p, {0.048, -0.535, 0.965}, 0.024, {0.06, -0.47, 0.93}, 0.020), 0.04);
}

// A limb in two parts, bent in the middle.
double bent_limb(const DVector& p, const DVector& a, double radius_a, const DVector& b, double radius_b,
                 const DVector& c, double radius_c) {
  return std::min(limb(p, a, radius_a, b, radius_b), limb(p, b, radius_b, c, radius_c));
}

double mouth(double d, const DVector& p) {
  d = carved(d, limb(p, {0, -0.55, 0.945}, 0.026, {0, -0.63, 0.945}, 0.030), 0.05);  // below the nose
  double upper =
      bent_limb(p, {0.05, -0.670, 0.864}, 0.042, {0.15, -0.692, 0.836}, 0.035, {0.245, -0.716, 0.786}, 0.016);
  upper = joined(upper, ball(p, {0, -0.682, 0.866}, 0.040), 0.03);
  const double lower =
      bent_limb(p, {0, -0.784, 0.856}, 0.054, {0.12, -0.774, 0.834}, 0.046, {0.225, -0.732, 0.786}, 0.016);
  d = joined(joined(d, upper, 0.03), lower, 0.04);
  d = carved(d, bent_limb(p, {0, -0.728, 0.915}, 0.016, {0.14, -0.732, 0.868}, 0.018, {0.26, -0.716, 0.808}, 0.014),
             0.025);
  return carved(d, limb(p, {0, -0.890, 0.93}, 0.06, {0.12, -0.875, 0.89}, 0.04), 0.10);  // above the chin
}

double ear(double d, const DVector& p) {
  // Turned outwards at the back, its upper end leaning back.
  DVector q = p - DVector(0.685, -0.14, -0.10);
  q = {0.96 * q.x + 0.28 * q.z, q.y + 0.25 * q.z, -0.28 * q.x + 0.96 * q.z};
  double shell = ellipsoid(q, {0, 0, 0}, {0.10, 0.29, 0.185});
  shell = carved(shell, ellipsoid(q, {0.105, 0.035, 0.015}, {0.060, 0.205, 0.125}), 0.02);
  shell = joined(shell, limb(q, {0.05, 0.10, -0.01}, 0.030, {0.05, -0.10, -0.045}, 0.030), 0.03);
  shell = joined(shell, ball(q, {0.02, -0.225, 0.045}, 0.075), 0.06);
  const double root = ellipsoid(p, {0.60, -0.16, -0.12}, {0.13, 0.25, 0.15});
  return joined(joined(d, root, 0.06), shell, 0.05);
}

double neck_and_shoulders(double d, const DVector& p) {
  d = joined(d, limb(p, {0, -0.85, -0.24}, 0.43, {0, -1.90, -0.40}, 0.47), 0.14);
  d = joined(d, limb(p, {0.37, -0.72, -0.27}, 0.06, {0.08, -1.86, 0.06}, 0.08), 0.14);
  double body = ellipsoid(p, {0, -2.70, -0.38}, {1.30, 0.95, 0.66});
  body = joined(body, ball(p, {1.42, -2.30, -0.45}, 0.47), 0.40);
  body = joined(body, limb(p, {0.15, -1.40, -0.50}, 0.25, {1.15, -2.03, -0.50}, 0.24), 0.30);
  body = joined(body, limb(p, {0.13, -1.88, 0.07}, 0.060, {1.25, -1.95, -0.25}, 0.06), 0.16);
  body = joined(body, ellipsoid(p, {0.50, -2.60, 0.02}, {0.56, 0.42, 0.29}), 0.18);
  body = carved(body, ball(p, {0, -1.91, 0.20}, 0.08), 0.10);
  // The cut of a classical bust: round below, drawn in towards the foot.
  body = common(body, ellipsoid(p, {0, -2.00, -0.38}, {1.78, 1.47, 1.30}), 0.05);
  return joined(d, body, 0.24);
}

// Hair combed back from a parting in waves, with a knot behind.
double hair(double d, const DVector& p) {
  double volume = ellipsoid(p, {0, 0.28, -0.15}, {0.80, 0.87, 0.96});
  // The hairline: around the face, and level over the ears, then down to the nape.
  const double face = std::sqrt(p.x * p.x / (0.64 * 0.64) + (p.y + 0.30) * (p.y + 0.30)) - 1;
  volume = carved(volume, std::max(0.6 * face, 0.02 - p.z), 0.06);
  const double below = 0.75 * (0.14 + 0.9 * std::min(p.z + 0.12, 0.0) - p.y);
  volume = common(volume, below, 0.08);
  const double around = elementary::atan2(p.x, p.y - 0.05);
  const double waves = elementary::cos(24 * around + 1.6 * elementary::sin(6.5 * p.z + 2.0 * around));
  const double depth = p.z > 0 ? std::clamp(0.3 + 2.5 * face, 0.3, 1.0) : 1.0;
  volume -= 0.022 * depth * waves;
  if (p.z > 0) volume += 0.035 * p.z * elementary::exp(-p.x * p.x / 0.002);  // the parting
  const DVector knot(0, -0.02, -1.0), k = p - knot;
  const double coil = elementary::atan2(k.x, k.y);
  const double bun =
      ellipsoid(p, knot, {0.34, 0.34, 0.27}) + 0.02 * elementary::cos(5 * coil + 26 * std::sqrt(k.x * k.x + k.y * k.y));
  return joined(d, joined(volume, bun, 0.05), 0.03);
}

}  // namespace

double bust_figure(const DVector& point) {
  const DVector p(std::abs(point.x), point.y, point.z);
  double d = neck_and_shoulders(skull_and_jaw(p), p);
  if (p.y > -1.4) {
    d = mouth(nose(eye(brow_and_sockets(d, p), p), p), p);
    d = hair(ear(d, p), p);
  }
  return common(d, kBustCut - p.y, 0.02);
}

}  // namespace facemap::generators
