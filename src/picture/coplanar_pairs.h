#pragma once

#include <facemap/scene.h>

#include <array>
#include <cstdint>

namespace facemap {

/// Whether two faces lie in one plane, asked again and again of the same few pairs: where they overlap they tie along
/// every ray, and no ray need be asked.
class CoplanarPairs {
 public:
  explicit CoplanarPairs(const Scene& scene) : scene_(scene) {}

  bool are_coplanar(std::uint32_t a, std::uint32_t b);

 private:
  struct Entry {
    std::uint32_t a = 0, b = 0;  // equal: none
    bool are_coplanar = false;
  };
  static constexpr std::size_t kEntries = 256;

  const Scene& scene_;
  std::array<Entry, kEntries> entries_;
};

}  // namespace facemap
