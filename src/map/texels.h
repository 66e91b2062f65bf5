#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "map/texel_entry.h"

namespace facemap {

/// The storage of a map: the faces of each texel, nearest bound first, as flat arrays. Nothing else knows its
/// layout.
class Texels {
 public:
  /// `entries` front to back within each texel. `nearest` gives each face's lower bound of distance; `cuts`
  /// (empty, or one a texel) a distance that a face covering the whole texel does not exceed: entries hidden
  /// behind it are dropped. Same units for both.
  Texels(std::size_t texel_count, std::span<const TexelEntry> entries, const float* nearest, std::vector<float> cuts);

  /// Margin, relative, between a query's distance and the bounds it is compared with. Distances of queries and
  /// bounds are rounded to float32 (2^-24, twice) and directions are off by 2^-24: below 2^-21 together.
  static constexpr float kDepthMargin = 0x1p-18f;

  /// Whether a face that begins at `nearest` cannot matter to a query that is not beyond `cut`, each side of
  /// that comparison taken with its margin.
  static bool is_hidden(float nearest, float cut) { return nearest > cut * (1 + 2 * kDepthMargin); }

  std::span<const std::uint32_t> faces_at(std::size_t texel) const {
    return {faces_.data() + offsets_[texel], offsets_[texel + 1] - offsets_[texel]};
  }

  /// Beyond this distance every direction of the texel is blocked; infinity if no face covers it.
  float cut(std::size_t texel) const { return cuts_.empty() ? std::numeric_limits<float>::infinity() : cuts_[texel]; }

  std::size_t entry_count() const noexcept { return faces_.size(); }
  std::size_t memory_bytes() const noexcept;

 private:
  std::vector<std::size_t> offsets_;
  std::vector<std::uint32_t> faces_;
  std::vector<float> cuts_;
};

}  // namespace facemap
