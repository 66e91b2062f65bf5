#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace facemap {

/// A picture as a texture wants it: 8 bits a channel, whatever the file had.
struct DecodedImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< rows from the top
  bool has_alpha = false;          ///< some pixel's alpha is not 255
};

/// The picture in the bytes of a PNG or JPEG file; which of the two they say themselves.
///
/// PNG of every colour type and depth, 16 bits rounded to 8. JPEG with Huffman codes: baseline and progressive, grey,
/// YCbCr, RGB, CMYK and YCCK. Colour profiles, gamma and EXIF's orientation are ignored: textures have none. The same
/// bytes give the same pixels on every machine.
///
/// Throws LoadError, naming `name`: UnknownFormat; TooLarge for more than `max_pixels`; BadImage, with the reason, for
/// a file that is broken or ends too early. No file makes it take memory out of proportion to what it could hold.
DecodedImage decode_image(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels);

}  // namespace facemap
