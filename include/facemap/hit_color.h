#pragma once

#include <facemap/color.h>

namespace facemap {

/// The colour of a direction in which so many faces lie, of a picture with at most `most` of them in any. Wang 2022,
/// Fig. 9: white for none, the darker the more. Every step shows where there are few, and many do not drown: the level
/// goes with the square root of the share.
Color hit_color(int hits, int most);

/// That of a pixel without a direction, outside of 360 degrees: pale blue.
Color no_direction_color();

}  // namespace facemap
