#include "map/texels.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "scene/reserve_pages.h"

namespace facemap {

Texels::Texels(std::size_t texel_count, std::span<const TexelEntry> entries, std::span<const float> cuts)
    : bases_(texel_count / kBlock + 1) {
  reserve_pages(texels_, texel_count + 1);
  texels_.resize(texel_count + 1);
  for (const TexelEntry& e : entries) ++texels_[e.texel].first;
  // Each list's end, then each list from its end.
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i <= texel_count; ++i) {
    if (i % kBlock == 0) bases_[i / kBlock] = sum;
    sum += texels_[i].first;
    const float cut = cuts.empty() || i == texel_count ? std::numeric_limits<float>::infinity() : cuts[i];
    texels_[i] = {static_cast<std::uint32_t>(sum), cut};
  }
  std::vector<std::uint64_t> sorted(sum);  // bound, whose bits are in its order, and face
  for (const TexelEntry& e : entries) {
    --texels_[e.texel].first;
    sorted[begin_of(e.texel)] = std::uint64_t{std::bit_cast<std::uint32_t>(e.nearest)} << 32 | e.face;
  }
  for (std::size_t i = 0; i < texel_count; ++i) {
    std::sort(sorted.begin() + begin_of(i), sorted.begin() + begin_of(i) + (texels_[i + 1].first - texels_[i].first));
  }
  reserve_pages(faces_, sum);
  for (const std::uint64_t key : sorted) faces_.push_back(static_cast<std::uint32_t>(key));
}

std::size_t Texels::memory_bytes() const noexcept {
  return texels_.size() * sizeof(Texel) + bases_.size() * sizeof(std::uint64_t) + faces_.size() * sizeof(std::uint32_t);
}

}  // namespace facemap
