#pragma once

#include <facemap/vector.h>

#include <optional>
#include <string>
#include <string_view>

namespace facemap {

/// Numbers of scene files as text and back: what is written reads back as the same bits.

/// The shortest decimal that is nearest to this value alone.
std::string shortest_text(double value);
std::string shortest_text(float value);

/// The float nearest to the shortest decimal of a double: what the same digits are on a command line. None if it is
/// too large for a float, or not finite.
std::optional<float> nearest_float(double value);

/// The unit vector that "x", "y", "z", "+x", "-x" and the like name.
std::optional<Vector> axis_of(std::string_view name);

/// Degrees as radians, and the shortest degrees that give these radians again; 17 digits where none do.
double radians_of(double degrees);
std::string degrees_of(double radians);

}  // namespace facemap
