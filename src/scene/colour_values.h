#pragma once

#include "scene/ply_header.h"

namespace facemap {

/// What the values of a colour's channel mean.
enum class ColourScale {
  Linear,  ///< 0..1, linear
  Srgb8,   ///< 0..255, sRGB
  Srgb16,  ///< 0..65535, sRGB
};

/// By a property's type: floats are linear, whole numbers sRGB.
ColourScale colour_scale_of(PlyType type);

/// The linear value in 0..1 of one as the file has it. `is_inside` becomes false if it had to be clamped.
float linear_channel(float value, ColourScale scale, bool& is_inside);

}  // namespace facemap
