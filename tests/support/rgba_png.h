#pragma once

#include <cstdint>
#include <vector>

/// A PNG file of 8-bit RGBA pixels, rows from the top, for tests of textures with alpha. At most 65535 bytes of rows.
std::vector<std::uint8_t> rgba_png(int width, int height, const std::vector<std::uint8_t>& rgba);
