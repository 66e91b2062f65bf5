#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "map/texel_entry.h"

namespace facemap {

/// The storage of a map: the faces of each texel, nearest bound first, then by id, as flat arrays. Nothing else knows
/// its layout.
class Texels {
 public:
  /// `entries` in any order. `cuts` (empty, or one a texel): a distance that a face covering the whole texel does not
  /// exceed. Entries hidden behind it may be missing.
  Texels(std::size_t texel_count, std::span<const TexelEntry> entries, std::span<const float> cuts);

  /// Margin, relative, between a query's distance and the bounds it is compared with. Distances of queries and
  /// bounds are rounded to float32 (2^-24, twice) and directions are off by 2^-24: below 2^-21 together.
  static constexpr float kDepthMargin = 0x1p-18f;

  /// Whether a face that begins at `nearest` cannot matter to a query that is not beyond `cut`, each side of
  /// that comparison taken with its margin.
  static bool is_hidden(float nearest, float cut) { return nearest > cut * (1 + 2 * kDepthMargin); }

  std::span<const std::uint32_t> faces_at(std::size_t texel) const {
    return {faces_.data() + begin_of(texel), texels_[texel + 1].first - texels_[texel].first};
  }

  /// Beyond this distance every direction of the texel is blocked; infinity if no face covers it.
  float cut(std::size_t texel) const { return texels_[texel].cut; }

  /// Has the processor fetch what faces_at and cut read.
  void prefetch(std::size_t texel) const { __builtin_prefetch(&texels_[texel]); }

  std::size_t entry_count() const noexcept { return faces_.size(); }
  std::size_t memory_bytes() const noexcept;

 private:
  // Half the size of two 64-bit numbers, and one cache line for both: the low half of where a list begins; where the
  // list of each block's first texel begins says the rest, as no block has 2^32 entries.
  struct Texel {
    std::uint32_t first;
    float cut;
  };
  static constexpr std::size_t kBlock = 256;  // texels

  std::size_t begin_of(std::size_t texel) const {
    const std::uint64_t base = bases_[texel / kBlock];
    return base + (texels_[texel].first - static_cast<std::uint32_t>(base));
  }

  std::vector<Texel> texels_;  // and one more: the end
  std::vector<std::uint64_t> bases_;
  std::vector<std::uint32_t> faces_;
};

}  // namespace facemap
