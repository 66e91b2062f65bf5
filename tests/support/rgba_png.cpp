#include "support/rgba_png.h"

#include "image/png_chunks.h"

std::vector<std::uint8_t> rgba_png(int width, int height, const std::vector<std::uint8_t>& rgba) {
  std::vector<std::uint8_t> rows;
  for (int y = 0; y < height; ++y) {
    rows.push_back(0);  // no filter
    rows.insert(rows.end(), rgba.begin() + 4 * width * y, rgba.begin() + 4 * width * (y + 1));
  }
  std::uint32_t a = 1, b = 0;  // Adler-32 (RFC 1950)
  for (const std::uint8_t byte : rows) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  // One block that is not compressed (RFC 1951).
  const auto size = static_cast<std::uint16_t>(rows.size());
  const auto low = [](std::uint16_t n) { return static_cast<std::uint8_t>(n & 0xff); };
  const auto high = [](std::uint16_t n) { return static_cast<std::uint8_t>(n >> 8); };
  const auto inverse = static_cast<std::uint16_t>(~size);
  std::vector<std::uint8_t> data;
  for (const std::uint8_t byte : {std::uint8_t{0x78}, std::uint8_t{0x01}, std::uint8_t{0x01}, low(size), high(size),
                                  low(inverse), high(inverse)}) {
    data.push_back(byte);
  }
  for (const std::uint8_t byte : rows) data.push_back(byte);
  facemap::png::append_32(data, b << 16 | a);

  std::vector<std::uint8_t> file = facemap::png::begin_file(width, height, 8, 6);
  facemap::png::append_chunk(file, "IDAT", data);
  facemap::png::append_chunk(file, "IEND", {});
  return file;
}
