#include "render/picture_frame.h"

#include <facemap/error.h>

namespace facemap {

Lens lens_of(const View& view, int width, int height) {
  if (view.is_parallel) return Lens::plane(1, width, height);
  if (!view.lens) return Projection(view.projection, view.field_angle, width, height);
  if (view.lens->width() != width || view.lens->height() != height) {
    throw Error("the view's lens is for a picture of " + std::to_string(view.lens->width()) + " x " +
                std::to_string(view.lens->height()) + " pixels, not " + std::to_string(width) + " x " +
                std::to_string(height));
  }
  return *view.lens;
}

SpaceVector frame_of(const View& view) { return SpaceVector::looking_at(view.position, view.look_at, view.up); }

PixelBox made_pixels(const Renderer::Options& options) {
  return options.crop.value_or(PixelBox{0, 0, options.width, options.height});
}

SampleGrid grid_of(const View& view, const Renderer::Options& options, int per_side) {
  const PixelBox pixels = made_pixels(options);
  SampleGrid grid{frame_of(view), lens_of(view, options.width, options.height), per_side};
  grid.first_column = pixels.x * per_side;
  grid.first_row = pixels.y * per_side;
  grid.column_count = pixels.width * per_side;
  grid.row_count = pixels.height * per_side;
  return grid;
}

}  // namespace facemap
