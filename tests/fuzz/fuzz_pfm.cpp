// Any bytes are a PFM or a LoadError.

#include <facemap/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "image/decode_pfm.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facemap;
  constexpr std::uint64_t kMaxPixels = 1 << 20;
  try {
    const PictureChannels picture = decode_pfm({data, size}, "fuzz.pfm", kMaxPixels);
    const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    if (pixels == 0 || pixels > kMaxPixels || picture.channels.size() % 2 != 1) std::abort();
    for (const auto& channel : picture.channels) {
      if (std::get<std::vector<float>>(channel.values).size() != pixels) std::abort();
    }
  } catch (const LoadError&) {
  }
  return 0;
}
