// Any bytes are a PNG or a LoadError, at 8 bits and at 16.

#include <facemap/error.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "image/decode_png.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facemap;
  constexpr std::uint64_t kMaxPixels = 1 << 20;
  try {
    const DecodedImage image = decode_png({data, size}, "fuzz.png", kMaxPixels);
    const DecodedImage16 image_16 = decode_png_16({data, size}, "fuzz.png", kMaxPixels);
    const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (pixels == 0 || pixels > kMaxPixels || image.rgba.size() != 4 * pixels) std::abort();
    if (image_16.rgba.size() != 4 * pixels) std::abort();
    for (std::size_t i = 0; i < 4 * pixels; ++i) {
      if ((image_16.rgba[i] + 128) / 257 != image.rgba[i]) std::abort();
    }
  } catch (const LoadError&) {
  }
  return 0;
}

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

constexpr std::size_t kSignature = 8, kFrame = 12;  ///< bytes before the chunks; of a chunk besides its data

std::uint32_t read_32(const std::uint8_t* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 | at[3];
}

/// Makes the sums of all whole chunks right.
void repair_sums(std::uint8_t* data, std::size_t size) {
  for (std::size_t at = kSignature; at + kFrame <= size;) {
    const std::size_t length = read_32(data + at);
    if (length > size - at - kFrame) return;
    const auto sum = static_cast<std::uint32_t>(crc32_z(0, data + at + 4, length + 4));
    for (unsigned i = 0; i < 4; ++i) data[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += kFrame + length;
  }
}

}  // namespace

/// Nearly every change would end at the first sum that is wrong.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned) {
  size = LLVMFuzzerMutate(data, size, max_size);
  repair_sums(data, size);
  return size;
}

#endif
