#pragma once

#include <facemap/space_vector.h>

#include "math/exact_sign.h"

namespace facemap {

/// Which directions of a cap a face may take, in double precision with slack for its roundings: only a filter.
///
/// A cap is all directions within rho of a unit direction c (local axes of a map). The face's cone is bounded by
/// three planes through the origin, so nothing is curved: the test is the same near the axis, at the rim and for
/// faces that surround either (Olano and Greer 1997 use the same planes on a projection plane).
class Cone {
 public:
  /// `side` is side(face, position of the frame), not 0.
  Cone(const Triangle& face, int side, const SpaceVector& frame);

  /// A cap's radius with what the tests need of it. Radii from 90 degrees on reject nothing and cover nothing.
  struct Radius {
    explicit Radius(double rho);
    double rho;  ///< radians
    double sine, cosine;
    bool is_small;  ///< below 90 degrees
  };

  /// False only if no direction of the cap hits the face.
  bool may_meet(const DVector& c, const Radius& radius) const;

  /// True only if every direction of the cap hits the face.
  bool surely_covers(const DVector& c, const Radius& radius) const;

  /// Upper bound of the face's distance from the origin along any direction of the cap, world units.
  double farthest(const DVector& c, const Radius& radius) const;

  /// Corners relative to the origin in local axes, and the largest angle between two of them (radians).
  const DVector& corner(int i) const { return corners_[i]; }
  double longest_angle() const { return longest_angle_; }

 private:
  DVector corners_[3];
  DVector edges_[3];      // unit, pointing inwards
  double edge_slack_[3];  // how far off they may be, radians
  DVector normal_;        // unit, pointing away from the origin
  double normal_slack_;
  double plane_distance_;  // upper bound
  double farthest_corner_;
  DVector cap_axis_;   // unit
  double cap_radius_;  // radians; every direction of the face is within it of the axis, if below 90 degrees
  double longest_angle_;
};

}  // namespace facemap
