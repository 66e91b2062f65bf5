#include "map/cone.h"

#include <algorithm>
#include <cmath>

#include "math/dvector.h"

namespace facemap {
namespace {

// Rounding of a cross product of two offsets rotated into local axes, relative to the product of their lengths:
// the differences (1 each), the rotation (3 each), the product (2), in units of 2^-53 a component; sqrt(3) for
// three components and a wide reserve.
constexpr double kCrossError = 0x1p-47;

// Rounding of a dot product of two unit vectors whose components are off by a few units of 2^-50.
constexpr double kDotError = 0x1p-46;

constexpr double kRightAngle = elementary::kPi / 2;

DVector difference(const Vector& a, const Vector& b) { return DVector(a) - DVector(b); }

}  // namespace

Cone::Radius::Radius(double r)
    : rho(r),
      sine(r < kRightAngle ? elementary::sin(r) : 1),
      cosine(r < kRightAngle ? elementary::cos(r) : 0),
      is_small(r < kRightAngle) {}

Cone::Cone(const Triangle& face, int side, const SpaceVector& frame) {
  for (int i = 0; i < 3; ++i) corners_[i] = frame.local_from_world(difference(face[i], frame.position()));
  // The frame is left-handed in world coordinates: a determinant of local vectors has the other sign.
  const double inwards = -side;
  DVector sum(0);
  farthest_corner_ = 0;
  longest_angle_ = 0;
  for (int i = 0; i < 3; ++i) {
    const DVector &a = corners_[i], &b = corners_[(i + 1) % 3];
    const DVector along = frame.local_from_world(difference(face[(i + 1) % 3], face[i]));
    const DVector m = cross(a, along);
    const double m_length = length(m), product = length(a) * length(along);
    edges_[i] = m_length > 0 ? m * (inwards / m_length) : DVector(0);
    edge_slack_[i] = m_length > 0 ? kCrossError * product / m_length + kDotError : 1;
    sum += a * (1 / length(a));
    farthest_corner_ = std::max(farthest_corner_, length(a));
    longest_angle_ = std::max(longest_angle_, angle_between(a, b));
  }
  longest_angle_ += 4 * elementary::kAngleError;
  farthest_corner_ *= 1 + kDotError;

  const DVector u = frame.local_from_world(difference(face[1], face[0]));
  const DVector v = frame.local_from_world(difference(face[2], face[0]));
  const DVector n = cross(u, v);
  const double n_length = length(n), sum_length = length(sum);
  normal_ = n_length > 0 ? n * (inwards / n_length) : DVector(0);
  normal_slack_ = n_length > 0 ? kCrossError * length(u) * length(v) / n_length + kDotError : 1;
  plane_distance_ = std::fabs(dot(normal_, corners_[0])) + (normal_slack_ + kDotError) * length(corners_[0]);

  cap_radius_ = elementary::kPi;
  cap_axis_ = DVector(0, 0, 1);
  if (sum_length > 0.1) {
    cap_axis_ = sum * (1 / sum_length);
    cap_radius_ = 0;
    for (const DVector& a : corners_) cap_radius_ = std::max(cap_radius_, angle_between(cap_axis_, a));
    cap_radius_ += 4 * elementary::kAngleError;
    if (cap_radius_ >= kRightAngle) cap_radius_ = elementary::kPi;  // only smaller caps are convex
  }
}

bool Cone::may_meet(const DVector& c, const Radius& radius) const {
  if (!radius.is_small) return true;
  for (int i = 0; i < 3; ++i) {
    if (dot(c, edges_[i]) < -(radius.sine + edge_slack_[i])) return false;
  }
  // The planes alone keep too much past sharp corners. A chord is never longer than its angle.
  const double reach = cap_radius_ + radius.rho + kDotError;
  const DVector chord = c - cap_axis_;
  return dot(chord, chord) <= reach * reach;
}

bool Cone::surely_covers(const DVector& c, const Radius& radius) const {
  if (!radius.is_small) return false;
  for (int i = 0; i < 3; ++i) {
    if (!(dot(c, edges_[i]) >= radius.sine + edge_slack_[i])) return false;
  }
  return true;
}

double Cone::farthest(const DVector& c, const Radius& radius) const {
  // Along a direction at angle phi from the normal the plane is plane_distance / cos phi away; over the cap phi
  // grows by rho at most.
  const double phi = angle_between(c, normal_) + radius.rho + normal_slack_ + 4 * elementary::kAngleError;
  if (!(phi < kRightAngle)) return farthest_corner_;
  const double cosine = elementary::cos(phi) - kDotError;
  return cosine > 0 ? std::min(farthest_corner_, plane_distance_ / cosine * (1 + kDotError)) : farthest_corner_;
}

}  // namespace facemap
