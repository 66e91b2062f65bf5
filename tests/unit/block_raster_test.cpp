#include "picture/block_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "picture/unset_vector.h"

namespace {

using facemap::BlockRaster;
using facemap::SharedPages;
using facemap::UnsetAllocator;
using facemap::UnsetVector;
using facemap::simd::column_of;
using facemap::simd::kBlockSamples;
using facemap::simd::kBlockSide;
using facemap::simd::RasterTarget;
using facemap::simd::row_of;
using facemap::simd::sample_at;

RasterTarget target_of(const BlockRaster& raster, int rows) { return raster.target(0, rows - 1, nullptr, nullptr); }

TEST(BlockRaster, EachSampleHasAPlaceOfItsOwn) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {5, 3}, {64, 7}, {70, 33}, {1024, 5}}) {
    const BlockRaster raster(columns, rows);
    const RasterTarget target = target_of(raster, rows);
    std::set<std::uint32_t> samples;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const std::uint32_t sample = sample_at(target.row_samples, column, row);
        EXPECT_EQ(column_of(target.row_samples, sample), column);
        EXPECT_EQ(row_of(target.row_samples, sample), row);
        EXPECT_EQ(target.w[sample], 0);
        target.faces[sample] = -1;  // may be written
        samples.insert(sample);
      }
    }
    EXPECT_EQ(samples.size(), static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  }
}

// Stores to one of two addresses with the same low 12 bits hold up loads from the other.
TEST(BlockRaster, BlocksNearEachOtherDifferInTheirLowBits) {
  constexpr int kNear = 6;
  const auto line_of = [](const void* place) { return reinterpret_cast<std::uintptr_t>(place) % 4096 / 64; };
  for (const int columns : {256, 640, 1000, 1024, 1920, 2048, 4096}) {
    const BlockRaster raster(columns, 64);
    const RasterTarget target = target_of(raster, 64);
    std::set<std::uintptr_t> lines;
    for (int row = 0; row < kNear; ++row) {
      for (int column = 0; column < kNear; ++column) {
        lines.insert(line_of(target.w + sample_at(target.row_samples, column * kBlockSide, row * kBlockSide)));
      }
    }
    EXPECT_EQ(lines.size(), std::size_t{kNear * kNear}) << columns;
    EXPECT_EQ(line_of(target.faces) - line_of(target.w), 33u) << columns;
    EXPECT_LT(target.row_samples, static_cast<std::uint32_t>(columns) * 9 / 2) << columns;  // 4 without spreading
  }
}

TEST(BlockRaster, ItsMemoryCanBeTakenByOthers) {
  BlockRaster raster(40, 30);
  const std::shared_ptr<SharedPages> memory = raster.release();
  EXPECT_TRUE(memory->has_room(40 * 30 * 2 * sizeof(float)));
  float* const values = memory->take<float>(40 * 30);
  ASSERT_NE(values, nullptr);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values) % 64, 0u);
  EXPECT_TRUE(memory->holds(values));
}

TEST(SharedPages, ArraysStandSideBySideAndOutliveWhoMadeThem) {
  UnsetVector<std::uint32_t> first, second, grown;
  {
    const auto pages = std::make_shared<SharedPages>(2 * SharedPages::room_for<std::uint32_t>(1000));
    first = UnsetVector<std::uint32_t>(1000, UnsetAllocator<std::uint32_t>(pages));
    second = UnsetVector<std::uint32_t>(1000, UnsetAllocator<std::uint32_t>(pages));
    grown = UnsetVector<std::uint32_t>(UnsetAllocator<std::uint32_t>(pages));
    EXPECT_TRUE(pages->holds(first.data()) && pages->holds(second.data()));
    EXPECT_FALSE(pages->has_room(64));
  }
  for (std::uint32_t i = 0; i < 1000; ++i) {
    first[i] = i;
    second[i] = 2 * i;
    grown.push_back(3 * i);  // of memory of its own
  }
  const UnsetVector<std::uint32_t> copy = first;
  first = std::move(second);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    ASSERT_EQ(copy[i], i);
    ASSERT_EQ(first[i], 2 * i);
    ASSERT_EQ(grown[i], 3 * i);
  }
}

TEST(SharedPages, WhatIsGivenBackLeavesWhatIsTaken) {
  SharedPages pages(std::size_t{3} << 20);
  std::uint8_t* const kept = pages.take<std::uint8_t>(100001);
  std::fill(kept, kept + 100001, std::uint8_t{7});
  pages.give_back_rest();
  EXPECT_EQ(pages.take<std::uint8_t>(1), nullptr);
  EXPECT_TRUE(pages.holds(kept));
  kept[100000] = 8;
  EXPECT_EQ(std::count(kept, kept + 100001, 7), 100000);
}

}  // namespace
