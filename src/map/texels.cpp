#include "map/texels.h"

#include <utility>

namespace facemap {

Texels::Texels(std::size_t texel_count, std::span<const TexelEntry> entries, const float* nearest,
               std::vector<float> cuts)
    : offsets_(texel_count + 1, 0), cuts_(std::move(cuts)) {
  const auto is_kept = [&](const TexelEntry& e) {
    return cuts_.empty() || !is_hidden(nearest[e.face], cuts_[e.texel]);
  };
  for (const TexelEntry& e : entries) {
    if (is_kept(e)) ++offsets_[e.texel + 1];
  }
  for (std::size_t i = 0; i < texel_count; ++i) offsets_[i + 1] += offsets_[i];
  faces_.resize(offsets_[texel_count]);
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for (const TexelEntry& e : entries) {
    if (is_kept(e)) faces_[next[e.texel]++] = e.face;
  }
}

std::size_t Texels::memory_bytes() const noexcept {
  return offsets_.size() * sizeof(std::size_t) + faces_.size() * sizeof(std::uint32_t) + cuts_.size() * sizeof(float);
}

}  // namespace facemap
