#include "image/image_limits.h"

#include <facemap/error.h>

namespace facemap {
namespace {

/// What a file of no bytes at all may promise: small pictures are not worth a question.
constexpr std::uint64_t kFreeUnits = std::uint64_t{1} << 16;

}  // namespace

void check_picture_size(const std::string& name, std::uint64_t width, std::uint64_t height, std::uint64_t max_pixels) {
  if (width == 0 || height == 0) throw LoadError(LoadError::Cause::BadImage, name, 0, "the picture has no pixels");
  constexpr std::uint64_t kMaxSide = 0x7fffffff;
  if (width <= kMaxSide && height <= kMaxSide && width <= max_pixels / height) return;
  throw LoadError(LoadError::Cause::TooLarge, name, 0,
                  "a picture of " + std::to_string(width) + "x" + std::to_string(height) + " pixels; at most " +
                      std::to_string(max_pixels) + " pixels are allowed");
}

void check_promise(const std::string& name, std::uint64_t units, std::uint64_t file_bytes, std::uint64_t units_a_byte) {
  if (units <= kFreeUnits || (units - kFreeUnits) / units_a_byte <= file_bytes) return;
  throw LoadError(LoadError::Cause::BadImage, name, 0,
                  "the header promises more than " + std::to_string(file_bytes) + " bytes can hold");
}

void refuse_picture(const std::string& name, const char* format, const std::string& reason) {
  throw LoadError(LoadError::Cause::BadImage, name, 0, std::string(format) + " cannot be read: " + reason);
}

}  // namespace facemap
