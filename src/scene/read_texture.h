#pragma once

#include <facemap/texture.h>

#include <cstdint>

#include "image/decode_image.h"

namespace facemap {

/// The pixels of an image that a model names. Throws Error as decode_image does, and if its file cannot be read.
DecodedImage read_texture(const TextureImage& image, std::uint64_t max_pixels);

}  // namespace facemap
