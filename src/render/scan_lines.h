#pragma once

#include <facemap/face.h>
#include <facemap/vector.h>

#include <cstdint>
#include <span>
#include <vector>

namespace facemap {

/// One sample a pixel with its depth buffer: the face that is nearest so far.
struct ScreenSamples {
  /// `x`, `y` in [0, 1): where in each pixel the sample lies. All samples start empty, at the far plane.
  ScreenSamples(int width, int height, double x, double y);

  int width, height;
  double x, y;
  std::vector<double> depths;  ///< 0 at the near plane, 1 at the far plane
  std::vector<FaceId> faces;   ///< kNoFace: none
};

/// Where to draw: one byte a pixel, 0 leaves it alone. An empty mask draws everywhere.
using PixelMask = std::vector<std::uint8_t>;

/// Fills a convex polygon of pixel coordinates and depths (Wang 2022, Alg. 1). A sample is inside if it is at or
/// right of the left crossing and left of the right one, at or below the top and above the bottom, so that no sample
/// belongs to two neighbours. It is drawn if its depth is below what is there. Parts off the screen are clipped.
void fill_scan_lines(std::span<const DVector> polygon, FaceId face, const PixelMask& mask, ScreenSamples& samples);

}  // namespace facemap
