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

TEST(Texels, ListsAreInTheOrderOfBoundsThenIds) {
  const std::vector<TexelEntry> entries{{0, 2, 2}, {0, 3, 1}, {2, 0, 5}, {0, 1, 1}, {0, 0, 3}};
  const Texels texels(3, entries, {});
  EXPECT_EQ(list(texels, 0), (std::vector<std::uint32_t>{1, 3, 2, 0}));
  EXPECT_TRUE(list(texels, 1).empty());
  EXPECT_EQ(list(texels, 2), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(texels.entry_count(), 5u);
  EXPECT_EQ(texels.cut(0), std::numeric_limits<float>::infinity());
}

TEST(Texels, FacesAreHiddenOnlyBeyondTheCutAndItsMargin) {
  // A query at the cut may be taken for one a little beyond it: what begins there must still be listed.
  const float cut = 2;
  for (const float nearest : {1.0f, cut, cut * (1 + Texels::kDepthMargin), cut * (1 + 1.9f * Texels::kDepthMargin)}) {
    EXPECT_FALSE(Texels::is_hidden(nearest, cut)) << nearest;
  }
  EXPECT_TRUE(Texels::is_hidden(cut * (1 + 3 * Texels::kDepthMargin), cut));
  EXPECT_TRUE(Texels::is_hidden(9, cut));
}

TEST(Texels, ListsOfManyTexelsBeginWhereTheLastOnesEnd) {
  std::vector<float> cuts;
  std::uint32_t count = 0;
  std::vector<TexelEntry> entries;
  for (std::uint32_t texel = 0; texel < 1000; ++texel) {
    cuts.push_back(static_cast<float>(texel));
    for (std::uint32_t i = 0; i < texel % 5; ++i) entries.push_back({texel, count++});
  }
  const Texels texels(1000, entries, cuts);
  std::uint32_t face = 0;
  for (std::uint32_t texel = 0; texel < 1000; ++texel) {
    EXPECT_EQ(texels.cut(texel), static_cast<float>(texel));
    ASSERT_EQ(texels.faces_at(texel).size(), texel % 5);
    for (const std::uint32_t id : texels.faces_at(texel)) EXPECT_EQ(id, face++);
  }
}

}  // namespace
