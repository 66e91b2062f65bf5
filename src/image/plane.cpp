#include "image/plane.h"

namespace facemap {
namespace {

template <typename Values>
PlaneView plane_of(const Image& image, int channels, const Values& values, const char* name) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (values.size() != pixels * static_cast<std::size_t>(channels)) {
    throw Error(std::string("the image has no plane of ") + name);
  }
  return {image.width, image.height, channels, std::span(values)};
}

}  // namespace

void check_plane(const char* format, const PlaneView& plane) {
  if (plane.width <= 0 || plane.height <= 0 || plane.channels <= 0)
    throw Error(std::string(format) + ": the image has no pixels");
  const std::size_t pixels = static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.height);
  const std::size_t count = std::visit([](const auto& values) { return values.size(); }, plane.values);
  const auto channels = static_cast<std::size_t>(plane.channels);
  if (count / channels != pixels || count % channels != 0)
    throw Error(std::string(format) + ": the plane has other values than it says");
}

PlaneView color_plane(const Image& image) {
  static_assert(sizeof(Color) == 3 * sizeof(float));
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.pixels.size() != pixels) throw Error("the image has no plane of colours");
  const auto* const first = reinterpret_cast<const float*>(image.pixels.data());
  return {image.width, image.height, 3, std::span(first, 3 * pixels)};
}

PlaneView id_plane(const Image& image) { return plane_of(image, 1, image.ids, "ids"); }
PlaneView depth_plane(const Image& image) { return plane_of(image, 1, image.depths, "depths"); }
PlaneView light_plane(const Image& image) { return plane_of(image, image.light_bytes(), image.lights, "lights"); }

}  // namespace facemap
