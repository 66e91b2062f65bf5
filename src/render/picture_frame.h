#pragma once

#include <facemap/lens.h>
#include <facemap/renderer.h>

#include "picture/sample_grid.h"

namespace facemap {

/// The lens of a view for a picture of this size; any for an orthographic one. Throws Error if the view's own is for
/// another size.
Lens lens_of(const View& view, int width, int height);

/// Position and axes of a view. Throws Error if there are none.
SpaceVector frame_of(const View& view);

/// The pixels that are to be made: Options::crop, or all.
PixelBox made_pixels(const Renderer::Options& options);

/// The rays of those pixels; of an orthographic view the frame and the places alone.
SampleGrid grid_of(const View& view, const Renderer::Options& options, int per_side);

}  // namespace facemap
