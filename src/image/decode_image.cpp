#include "image/decode_image.h"

#include <facemap/error.h>

#include "image/decode_jpeg.h"
#include "image/decode_png.h"

namespace facemap {

DecodedImage decode_image(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  if (is_png(bytes)) return decode_png(bytes, name, max_pixels);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name, max_pixels);
  throw LoadError(LoadError::Cause::UnknownFormat, name, 0, "it is neither PNG nor JPEG");
}

}  // namespace facemap
