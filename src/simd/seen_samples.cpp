#include "simd/seen_samples.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/seen_samples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"
#include "simd/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using DI = hn::CappedTag<std::int32_t, kRunColumns>;
using DU = hn::RebindToUnsigned<DI>;

alignas(64) constexpr std::uint32_t kCounted[kRunColumns] = {0, 1, 2, 3, 4, 5, 6, 7};

// Stores whole vectors: as many samples have been passed as there may be before `count`.
HWY_INLINE std::size_t list_run(const TileFaces& tile, std::size_t column, std::size_t row, std::size_t count,
                                std::uint32_t* columns, const SampleLists& lists) {
  const DI di;
  const DU du;
  const std::size_t first = row * tile.stride + column;
  for (std::size_t i = 0; i < kRunColumns; i += hn::Lanes(di)) {
    const auto faces = hn::LoadU(di, tile.faces + first + i);
    const auto seen = hn::Gt(faces, hn::Set(di, -1));
    if (hn::AllFalse(di, seen)) continue;
    const auto in_tile = hn::Add(hn::Load(du, kCounted + i), hn::Set(du, static_cast<std::uint32_t>(column)));
    const auto number = tile.first_sample + static_cast<std::uint32_t>(row * tile.stride);
    const Packer<DU> packer(hn::RebindMask(du, seen));
    packer.store(hn::Add(in_tile, hn::Set(du, number)), lists.samples + count);
    packer.store(hn::BitCast(du, faces), lists.faces + count);
    packer.store(in_tile, columns + count);
    for (std::size_t k = 0; k < hn::Lanes(di); ++k) lists.map_y[count + k] = tile.map_y[row];
    count += packer.count();
  }
  return count;
}

}  // namespace

std::size_t list_samples(const TileFaces& tile, int columns, int rows, const SampleLists& lists) {
  std::uint32_t in_tile[kSeenBatch];
  std::size_t count = 0;
  for (int column = 0; column < columns; column += kRunColumns) {
    for (int row = 0; row < rows; ++row) {
      count = list_run(tile, static_cast<std::size_t>(column), static_cast<std::size_t>(row), count, in_tile, lists);
    }
  }
  for (std::size_t i = 0; i < count; ++i) lists.map_x[i] = tile.map_x[in_tile[i]];
  return count;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

std::size_t list_samples(const TileFaces& tile, int columns, int rows, const SampleLists& lists) {
  return FACEMAP_DISPATCH(list_samples)(tile, columns, rows, lists);
}

}  // namespace facemap::simd
#endif
