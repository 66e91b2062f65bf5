#pragma once

#include <facemap/material.h>

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace facemap {

/// Materials for formats that give faces a colour each: one a colour, in order of first sight.
class ColourMaterials {
 public:
  static constexpr std::size_t kMost = 1 << 16;  ///< colours: faces with more have none, as in a scan's noise

  explicit ColourMaterials(std::vector<Material>& materials) : materials_(materials) {}

  /// The index of the material of that colour (0xRRGGBB, sRGB); kNoIndex if it would be one too many.
  std::uint32_t of(std::uint32_t rgb);

 private:
  std::vector<Material>& materials_;
  std::unordered_map<std::uint32_t, std::uint32_t> known_;
  std::uint32_t last_rgb_ = kNoIndex, last_material_ = kNoIndex;
};

}  // namespace facemap
