#pragma once

#include <facemap/lens.h>
#include <facemap/renderer.h>

#include "picture/sample_grid.h"

namespace facemap {

/// The lens of a view for a picture of this size. Throws Error if the view's own is for another size, or the view is
/// orthographic.
Lens lens_of(const View& view, int width, int height);

/// Position and axes of a view. Throws Error if there are none.
SpaceVector frame_of(const View& view);

/// The pixels that are to be made: Options::crop, or all.
PixelBox made_pixels(const Renderer::Options& options);

/// The rays of those pixels.
SampleGrid grid_of(const View& view, const Renderer::Options& options, int per_side);

}  // namespace facemap
