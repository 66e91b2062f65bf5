#pragma once

#include <cstddef>

namespace facemap::simd {

/// Points of a picture are worked on in batches of at most this many.
inline constexpr std::size_t kSeenBatch = 256;

/// A camera's frame and projection, as far as directions need them.
struct RayFrame {
  double axis_x[3], axis_y[3], axis_z[3];
  double texel_angle;  ///< Projection::texel_angle
  bool is_surface;     ///< surface projection, else plane
};

/// Directions of rays through map points that have one: x to the right and y upwards of the map's centre, in texels.
/// The same bits as SampleGrid::direction. Arrays have kSeenBatch elements, those from `count` on being of no meaning.
void ray_directions(const RayFrame& frame, const double* x, const double* y, std::size_t count, float* direction_x,
                    float* direction_y, float* direction_z);

}  // namespace facemap::simd
