#pragma once

#include <facemap/camera.h>
#include <facemap/lens.h>

namespace facemap {

/// A camera's map for all rays of a picture: one that rounding to float32 moves past the picture's border is asked all
/// the same.
Camera::Options wide_map(const Lens& lens);

}  // namespace facemap
