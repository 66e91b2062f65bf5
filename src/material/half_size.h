#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace facemap {

/// Four channels a texel, of which three go through a table.
struct ByteTexels {
  const std::uint8_t* rgba;
  const float* linear;

  float operator()(std::size_t texel, int channel) const {
    const std::uint8_t byte = rgba[4 * texel + static_cast<std::size_t>(channel)];
    return channel == 3 ? static_cast<float>(byte) * (1 / 255.0f) : linear[byte];
  }
};

/// The same as numbers.
struct FloatTexels {
  const float* rgba;

  float operator()(std::size_t texel, int channel) const { return rgba[4 * texel + static_cast<std::size_t>(channel)]; }
};

/// Which texels of a row of `size` lie below texel i of a row of half as many, rounded down, and with which shares:
/// three where the size is odd.
struct BoxTaps {
  int first = 0, count = 1;
  float shares[3] = {1, 0, 0};

  BoxTaps(int i, int size) {
    if (size == 1) return;
    const int half = size / 2;
    // Lengths in 1/half of a texel: the box is `size` long.
    const std::int64_t begin = std::int64_t{i} * size, end = begin + size;
    first = static_cast<int>(begin / half);
    count = 0;
    for (std::int64_t texel = first; texel * half < end; ++texel, ++count) {
      const std::int64_t overlap = std::min(end, (texel + 1) * half) - std::max(begin, texel * half);
      shares[count] = static_cast<float>(static_cast<double>(overlap) / size);
    }
  }
};

/// The means over boxes of an image, half as wide and half as high (rounded down, at least 1): exactly the area that a
/// texel of the result covers, so that the mean of the whole stays. `by_alpha`: colours count as much as there is of
/// them, so that those of clear texels do not.
template <class Texels>
std::vector<float> half_size(const Texels& texels, int width, int height, bool by_alpha = false) {
  const int new_width = std::max(1, width / 2), new_height = std::max(1, height / 2);
  std::vector<BoxTaps> columns;
  columns.reserve(static_cast<std::size_t>(new_width));
  for (int x = 0; x < new_width; ++x) columns.emplace_back(x, width);
  std::vector<float> result(4 * static_cast<std::size_t>(new_width) * static_cast<std::size_t>(new_height));
  float* out = result.data();
  for (int y = 0; y < new_height; ++y) {
    const BoxTaps rows(y, height);
    for (int x = 0; x < new_width; ++x, out += 4) {
      const BoxTaps& taps = columns[static_cast<std::size_t>(x)];
      float weighted[3] = {0, 0, 0};
      for (int j = 0; j < rows.count; ++j) {
        const std::size_t row = static_cast<std::size_t>(rows.first + j) * static_cast<std::size_t>(width);
        for (int i = 0; i < taps.count; ++i) {
          const float share = rows.shares[j] * taps.shares[i];
          const std::size_t texel = row + static_cast<std::size_t>(taps.first + i);
          for (int k = 0; k < 4; ++k) out[k] += share * texels(texel, k);
          for (int k = 0; by_alpha && k < 3; ++k) weighted[k] += share * texels(texel, 3) * texels(texel, k);
        }
      }
      for (int k = 0; by_alpha && out[3] > 0 && k < 3; ++k) out[k] = weighted[k] / out[3];
    }
  }
  return result;
}

}  // namespace facemap
