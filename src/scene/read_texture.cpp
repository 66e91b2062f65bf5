#include "scene/read_texture.h"

#include <span>

#include "scene/file_mapping.h"

namespace facemap {
namespace {

// Of an image's file: more than any that decodes to the pixels allowed.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31;

}  // namespace

DecodedImage read_texture(const TextureImage& image, std::uint64_t max_pixels) {
  if (image.file.empty()) return decode_image(image.bytes, image.name, max_pixels);
  const FileMapping file(image.file, kMostBytes);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(file.text().data());
  return decode_image(std::span(bytes, file.text().size()), image.file.string(), max_pixels);
}

}  // namespace facemap
