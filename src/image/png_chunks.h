#pragma once

#include <facemap/display.h>

#include <cstdint>
#include <vector>

namespace facemap::png {

inline constexpr std::uint8_t kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

/// Most significant byte first.
void append_32(std::vector<std::uint8_t>& bytes, std::uint32_t value);

/// Begins a chunk of PNG. finish_chunk() sets its length, of what was appended to `bytes` meanwhile, and adds its sum.
void begin_chunk(std::vector<std::uint8_t>& bytes, const char* type);
void finish_chunk(std::vector<std::uint8_t>& bytes, std::size_t begin);

void append_chunk(std::vector<std::uint8_t>& bytes, const char* type, const std::vector<std::uint8_t>& data);

/// Signature and header: `depth` bits a channel, not interlaced.
std::vector<std::uint8_t> begin_file(int width, int height, int depth, int color_type);

/// Says how the levels stand for light.
void append_transfer(std::vector<std::uint8_t>& bytes, Transfer transfer);

/// Rows that are compressed as a part of the stream, in a chunk of their own; and what the stream's sum needs of them.
struct Band {
  std::vector<std::uint8_t> chunk;  ///< IDAT; of the last band it is not finished
  unsigned long adler = 1;          ///< of the rows
  std::size_t bytes = 0;            ///< of the rows
};

/// Appends the bands' chunks, the stream's sum, and the file's end. Empties the bands.
void append_bands(std::vector<std::uint8_t>& bytes, std::vector<Band>& bands);

}  // namespace facemap::png
