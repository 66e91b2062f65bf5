#include "map/texels.h"

#include <limits>
#include <utility>

#include "scene/reserve_pages.h"

namespace facemap {

Texels::Texels(std::size_t texel_count, std::span<const TexelEntry> entries, const float* nearest,
               std::span<const float> cuts)
    : bases_(texel_count / kBlock + 1) {
  reserve_pages(texels_, texel_count + 1);
  texels_.resize(texel_count + 1);
  const auto is_kept = [&](const TexelEntry& e) { return cuts.empty() || !is_hidden(nearest[e.face], cuts[e.texel]); };
  std::vector<std::uint64_t> next(texel_count + 1, 0);
  for (const TexelEntry& e : entries) {
    if (is_kept(e)) ++next[e.texel];
  }
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i <= texel_count; ++i) {
    if (i % kBlock == 0) bases_[i / kBlock] = sum;
    const float cut = cuts.empty() || i == texel_count ? std::numeric_limits<float>::infinity() : cuts[i];
    texels_[i] = {static_cast<std::uint32_t>(sum), cut};
    sum += std::exchange(next[i], sum);
  }
  reserve_pages(faces_, sum);
  faces_.resize(sum);
  for (const TexelEntry& e : entries) {
    if (is_kept(e)) faces_[next[e.texel]++] = e.face;
  }
}

std::size_t Texels::memory_bytes() const noexcept {
  return texels_.size() * sizeof(Texel) + bases_.size() * sizeof(std::uint64_t) + faces_.size() * sizeof(std::uint32_t);
}

}  // namespace facemap
