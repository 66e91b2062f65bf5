#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace facemap::exr {

/// As OpenEXR numbers them.
enum class PixelType : std::uint32_t { Uint = 0, Half = 1, Float = 2 };

inline std::size_t size_of(PixelType type) { return type == PixelType::Half ? 2 : 4; }

struct Channel {
  std::string name;
  PixelType type;
};

inline constexpr int kRowsOfChunk = 16;  ///< of ZIP compression

/// Magic number, version and header of a file of scan lines. `channels` are sorted by name.
std::vector<std::uint8_t> begin_file(const std::vector<Channel>& channels, int width, int height);

/// The data of a chunk: zlib's stream of the bytes, sorted and turned into differences, or the bytes themselves if that
/// is no shorter. `raw`: row by row, channel by channel.
std::vector<std::uint8_t> compress(const std::vector<std::uint8_t>& raw);

/// The whole file: `chunks` from the top of the picture, which are used up.
std::vector<std::uint8_t> finish_file(std::vector<std::uint8_t>&& header,
                                      std::vector<std::vector<std::uint8_t>>& chunks);

}  // namespace facemap::exr
