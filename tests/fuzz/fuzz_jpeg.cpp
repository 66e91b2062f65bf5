// Any bytes are a JPEG or a LoadError.

#include <facemap/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "image/decode_jpeg.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facemap;
  constexpr std::uint64_t kMaxPixels = 1 << 20;
  try {
    const DecodedImage image = decode_jpeg({data, size}, "fuzz.jpg", kMaxPixels);
    const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (pixels == 0 || pixels > kMaxPixels || image.rgba.size() != 4 * pixels || image.has_alpha) std::abort();
  } catch (const LoadError&) {
  }
  return 0;
}
