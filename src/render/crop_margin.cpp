#include "render/crop_margin.h"

#include <algorithm>

#include "render/edge_pixels.h"
#include "render/picture_frame.h"
#include "render/pixel_filter.h"

namespace facemap {
namespace {

// `channels` elements a pixel; a plane that is not there stays empty.
template <class T>
std::vector<T> cut_plane(const std::vector<T>& plane, std::size_t channels, const PixelBox& made,
                         const PixelBox& wanted) {
  std::vector<T> part;
  for (int y = wanted.y - made.y; !plane.empty() && y < wanted.y - made.y + wanted.height; ++y) {
    const auto first = static_cast<std::ptrdiff_t>(channels) * (std::ptrdiff_t{y} * made.width + wanted.x - made.x);
    const auto count = static_cast<std::ptrdiff_t>(channels) * wanted.width;
    part.insert(part.end(), plane.begin() + first, plane.begin() + first + count);
  }
  return part;
}

}  // namespace

PixelBox pixels_about_crop(const Renderer::Options& options) {
  const PixelBox wanted = made_pixels(options);
  int margin = PixelFilter(options.filter, options.filter_width, options.samples).reach();
  if (options.sampling == Renderer::Sampling::Edges) margin += EdgePixels::kReach;
  const int left = std::max(0, wanted.x - margin), top = std::max(0, wanted.y - margin);
  const int right = std::min(options.width, wanted.x + wanted.width + margin);
  const int bottom = std::min(options.height, wanted.y + wanted.height + margin);
  return {left, top, right - left, bottom - top};
}

Image cut(const Image& image, const PixelBox& made, const PixelBox& wanted) {
  Image part;
  part.width = wanted.width;
  part.height = wanted.height;
  part.light_count = image.light_count;
  part.pixels = cut_plane(image.pixels, 1, made, wanted);
  part.ids = cut_plane(image.ids, 1, made, wanted);
  part.lights = cut_plane(image.lights, static_cast<std::size_t>(image.light_bytes()), made, wanted);
  return part;
}

}  // namespace facemap
