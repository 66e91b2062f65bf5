#pragma once

#include <facemap/error.h>
#include <facemap/image_file.h>

#include <span>
#include <string>
#include <type_traits>
#include <vector>

/// A plane with values of its own: they look random and are the same each time; floats are in 0..1.
template <typename Value>
struct TestPlane {
  TestPlane(int plane_width, int plane_height, int plane_channels)
      : width(plane_width), height(plane_height), channels(plane_channels) {
    std::uint32_t state = 7;
    for (int i = 0; i < width * height * channels; ++i) {
      state = state * 1664525 + 1013904223;
      if constexpr (std::is_floating_point_v<Value>) {
        values.push_back(static_cast<Value>(state >> 8) * 0x1p-24f);
      } else {
        values.push_back(static_cast<Value>(state >> (32 - 8 * sizeof(Value))));
      }
    }
  }

  facemap::PlaneView view() const { return {width, height, channels, std::span<const Value>(values)}; }

  int width, height, channels;
  std::vector<Value> values;
};

/// What the error says that `action` throws.
template <typename Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const facemap::Error& error) {
    return error.what();
  }
  return "no error";
}
