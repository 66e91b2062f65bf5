#include "scene/generators/chess_foot.h"

namespace facemap::generators {

Profile turned_foot(double base, double shoulder, int detail) {
  constexpr double kQuarter = 0.41421356237309503;  // bulge of a quarter circle
  Profile profile(0, 0, detail);
  profile.line(base - 0.015, 0).arc(base, 0.015, kQuarter, 2).line(base, 0.055);
  profile.line(base - 0.03, 0.065).arc(shoulder + 0.02, 0.155, 0.35, 5);
  profile.line(shoulder, 0.16).line(shoulder, 0.18);
  return profile;
}

}  // namespace facemap::generators
