#include <bit>
#include <cstring>

#include "image/plane.h"

namespace facemap {

std::vector<std::uint8_t> encode_pfm(const PlaneView& plane) {
  static_assert(std::endian::native == std::endian::little, "a negative scale says so");
  const std::span<const float> values = values_of<float>("PFM", plane, {1, 3});
  const std::string header = std::string(plane.channels == 3 ? "PF" : "Pf") + "\n" + std::to_string(plane.width) + " " +
                             std::to_string(plane.height) + "\n-1.0\n";
  std::vector<std::uint8_t> bytes(header.size() + values.size_bytes());
  std::memcpy(bytes.data(), header.data(), header.size());
  std::uint8_t* to = bytes.data() + header.size();
  const auto height = static_cast<std::size_t>(plane.height);
  const std::size_t row = values.size() / height;
  for (std::size_t y = height; y-- > 0; to += row * sizeof(float))
    std::memcpy(to, values.data() + y * row, row * sizeof(float));
  return bytes;
}

}  // namespace facemap
