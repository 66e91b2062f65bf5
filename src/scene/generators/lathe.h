#pragma once

#include <vector>

#include "scene/generators/solids.h"

namespace facemap::generators {

/// The outline of a turned piece: points (radius, height) drawn upwards, with the piece on the left.
/// Curves take their number of segments times `detail`; straight lines stay one segment.
class Profile {
 public:
  Profile(double radius, double height, int detail);

  Profile& line(double radius, double height);

  /// A circular arc; bulge = tan(angle / 4), positive if it swells to the outside.
  Profile& arc(double radius, double height, double bulge, int segments);

  /// A quadratic Bezier curve.
  Profile& curve(double control_radius, double control_height, double radius, double height, int segments);

  /// Goes level to a sphere about the axis and along it to where its radius is `end_radius` again.
  Profile& sphere(double centre_height, double sphere_radius, double end_radius, int segments);

  const Outline& points() const { return points_; }
  double radius() const { return points_.back().x; }
  double height() const { return points_.back().y; }

 private:
  Outline points_;
  int detail_;
};

/// A circle of points about the y axis, from +x towards -z: counter-clockwise seen from above.
Ring circle(Solid& solid, double radius, double height, int segments);

/// Turns a profile about the y axis. Ends at radius 0 become poles; other ends stay open.
Solid lathe(const Profile& profile, int segments);

/// Adds the turned profile to `solid`, starting from the loop `first` (empty: from the profile's first point).
/// Returns the last loop, empty if it ends in a pole.
Ring lathe_onto(Solid& solid, const Profile& profile, int segments, const Ring& first);

/// Part of a ring about the y axis: a convex section (radius, height), counter-clockwise, swept over the angles
/// `from` to `to` (0 at +x, growing towards -z), with flat ends.
Solid sweep(const Outline& section, double from, double to, int segments);

}  // namespace facemap::generators
