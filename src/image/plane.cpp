#include "image/plane.h"

namespace facemap {
namespace {

/// The numbers of `channels` a pixel that `values` are made of.
template <typename Number, typename Value>
PlaneView numbers_of(const Image& image, int channels, const std::vector<Value>& values, const char* name) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const std::size_t count = values.size() * (sizeof(Value) / sizeof(Number));
  if (count != pixels * static_cast<std::size_t>(channels) || count == 0) {
    throw Error(std::string("the image has no plane of ") + name);
  }
  return {image.width, image.height, channels, std::span(reinterpret_cast<const Number*>(values.data()), count)};
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

static_assert(sizeof(Color) == 3 * sizeof(float) && sizeof(Vector) == 3 * sizeof(float));
static_assert(sizeof(glm::vec2) == 2 * sizeof(float));

PlaneView color_plane(const Image& image) { return numbers_of<float>(image, 3, image.pixels, "colours"); }

PlaneView plane_view(const Image& image, Plane plane) {
  const char* const name = name_of(plane);
  switch (plane) {
    case Plane::Id:
      return numbers_of<std::int32_t>(image, 1, image.ids, name);
    case Plane::Depth:
      return numbers_of<float>(image, 1, image.depths, name);
    case Plane::Z:
      return numbers_of<float>(image, 1, image.zs, name);
    case Plane::Position:
      return numbers_of<float>(image, 3, image.positions, name);
    case Plane::Normal:
      return numbers_of<float>(image, 3, image.normals, name);
    case Plane::FaceNormal:
      return numbers_of<float>(image, 3, image.face_normals, name);
    case Plane::Albedo:
      return numbers_of<float>(image, 3, image.albedos, name);
    case Plane::Uv:
      return numbers_of<float>(image, 2, image.uvs, name);
    case Plane::Object:
      return numbers_of<std::int32_t>(image, 1, image.objects, name);
    case Plane::Material:
      return numbers_of<std::int32_t>(image, 1, image.materials, name);
    case Plane::Lights:
      return numbers_of<std::uint8_t>(image, image.light_bytes(), image.lights, name);
    case Plane::Shadows:
      return numbers_of<std::int32_t>(image, 1, image.shadows, name);
  }
  throw Error("no such plane");
}

}  // namespace facemap
