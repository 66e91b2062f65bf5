#pragma once

#include <facemap/error.h>
#include <facemap/image_file.h>

#include <cstddef>
#include <initializer_list>

namespace facemap {

/// Throws Error "FORMAT: ..." if the plane has no pixels, or other values than it says.
void check_plane(const char* format, const PlaneView& plane);

/// The values of a plane that must be of type Value and have one of these numbers of channels. Throws Error.
template <typename Value>
std::span<const Value> values_of(const char* format, const PlaneView& plane, std::initializer_list<int> channels) {
  check_plane(format, plane);
  const auto* const values = std::get_if<std::span<const Value>>(&plane.values);
  if (!values) throw Error(std::string(format) + ": the plane is of another type than the format has");
  for (const int count : channels) {
    if (count == plane.channels) return *values;
  }
  throw Error(std::string(format) + ": the format has no " + std::to_string(plane.channels) + " channels");
}

}  // namespace facemap
