#include "image/png_chunks.h"

#include <facemap/error.h>
#include <png.h>
#include <zlib.h>

#include <iterator>

namespace facemap::png {

void append_32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void begin_chunk(std::vector<std::uint8_t>& bytes, const char* type) {
  append_32(bytes, 0);
  bytes.insert(bytes.end(), type, type + 4);
}

void finish_chunk(std::vector<std::uint8_t>& bytes, std::size_t begin) {
  const std::size_t length = bytes.size() - begin - 8;
  if (length > 0x7fffffff) throw Error("PNG: the image is too large");
  for (int i = 0; i < 4; ++i) bytes[begin + i] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
  append_32(bytes, static_cast<std::uint32_t>(crc32_z(0, bytes.data() + begin + 4, length + 4)));
}

void append_chunk(std::vector<std::uint8_t>& bytes, const char* type, const std::vector<std::uint8_t>& data) {
  const std::size_t begin = bytes.size();
  begin_chunk(bytes, type);
  bytes.insert(bytes.end(), data.begin(), data.end());
  finish_chunk(bytes, begin);
}

void append_transfer(std::vector<std::uint8_t>& bytes, Transfer transfer) {
  if (transfer == Transfer::Srgb) return append_chunk(bytes, "sRGB", {PNG_sRGB_INTENT_PERCEPTUAL});
  std::vector<std::uint8_t> gamma;
  append_32(gamma, 100'000);  // 1, in units of 1/100000
  append_chunk(bytes, "gAMA", gamma);
}

std::vector<std::uint8_t> begin_file(int width, int height, int depth, int color_type) {
  std::vector<std::uint8_t> header;
  append_32(header, static_cast<std::uint32_t>(width));
  append_32(header, static_cast<std::uint32_t>(height));
  header.insert(header.end(), {static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(color_type),
                               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE, PNG_INTERLACE_NONE});
  std::vector<std::uint8_t> bytes(std::begin(kSignature), std::end(kSignature));
  append_chunk(bytes, "IHDR", header);
  constexpr char kSoftware[] = "Software\0FaceMap";  // by this the program knows pictures of its own
  append_chunk(bytes, "tEXt", {std::begin(kSoftware), std::end(kSoftware) - 1});
  return bytes;
}

void append_bands(std::vector<std::uint8_t>& bytes, std::vector<Band>& bands) {
  uLong adler = bands[0].adler;
  for (std::size_t i = 1; i < bands.size(); ++i) {
    adler = adler32_combine(adler, bands[i].adler, static_cast<z_off_t>(bands[i].bytes));
  }
  append_32(bands.back().chunk, static_cast<std::uint32_t>(adler));
  finish_chunk(bands.back().chunk, 0);
  for (Band& band : bands) {
    bytes.insert(bytes.end(), band.chunk.begin(), band.chunk.end());
    band.chunk = {};
  }
  append_chunk(bytes, "IEND", {});
}

}  // namespace facemap::png
