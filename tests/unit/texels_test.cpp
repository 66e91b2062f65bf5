#include "map/texels.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

using facemap::TexelEntry;
using facemap::Texels;

std::vector<std::uint32_t> list(const Texels& texels, std::size_t texel) {
  const auto faces = texels.faces_at(texel);
  return {faces.begin(), faces.end()};
}

TEST(Texels, ListsKeepTheOrderOfTheEntries) {
  const std::vector<float> nearest{3, 1, 2, 1};
  const std::vector<TexelEntry> entries{{0, 1}, {0, 3}, {0, 2}, {2, 0}, {0, 0}};
  const Texels texels(3, entries, nearest.data(), {});
  EXPECT_EQ(list(texels, 0), (std::vector<std::uint32_t>{1, 3, 2, 0}));
  EXPECT_TRUE(list(texels, 1).empty());
  EXPECT_EQ(list(texels, 2), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(texels.entry_count(), 5u);
  EXPECT_EQ(texels.cut(0), std::numeric_limits<float>::infinity());
}

TEST(Texels, EntriesAreDroppedOnlyBeyondTheCutAndItsMargin) {
  // A query at the cut may be taken for one a little beyond it: what begins there must still be listed.
  const float cut = 2;
  const std::vector<float> nearest{1,
                                   2,
                                   cut * (1 + Texels::kDepthMargin),
                                   cut * (1 + 1.9f * Texels::kDepthMargin),
                                   cut * (1 + 3 * Texels::kDepthMargin),
                                   9};
  const std::vector<TexelEntry> entries{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}};
  const Texels texels(1, entries, nearest.data(), {&cut, 1});
  EXPECT_EQ(list(texels, 0), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(texels.cut(0), cut);
}

TEST(Texels, ListsOfManyTexelsBeginWhereTheLastOnesEnd) {
  std::vector<float> nearest, cuts;
  std::vector<TexelEntry> entries;
  for (std::uint32_t texel = 0; texel < 1000; ++texel) {
    cuts.push_back(static_cast<float>(texel));
    for (std::uint32_t i = 0; i < texel % 5; ++i) {
      entries.push_back({texel, static_cast<std::uint32_t>(nearest.size())});
      nearest.push_back(0);
    }
  }
  const Texels texels(1000, entries, nearest.data(), cuts);
  std::uint32_t face = 0;
  for (std::uint32_t texel = 0; texel < 1000; ++texel) {
    EXPECT_EQ(texels.cut(texel), static_cast<float>(texel));
    ASSERT_EQ(texels.faces_at(texel).size(), texel % 5);
    for (const std::uint32_t id : texels.faces_at(texel)) EXPECT_EQ(id, face++);
  }
}

}  // namespace
