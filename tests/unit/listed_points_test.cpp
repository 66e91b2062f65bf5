#include "simd/listed_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "picture/point_list.h"
#include "simd/target.h"
#include "support/random.h"

namespace facemap {
namespace {

struct Case {
  std::vector<std::int32_t> coordinates[3];
  std::vector<std::uint8_t> masks;
  std::size_t count, stride;

  // Runs of points that ask and of points that do not, as long as vectors and shorter.
  Case(std::size_t points, std::size_t bytes, Random& random) : masks(points * bytes), count(points), stride(bytes) {
    for (auto& c : coordinates) {
      for (std::size_t i = 0; i < points; ++i)
        c.push_back(static_cast<std::int32_t>(random.below(1 << 30)) - (1 << 29));
    }
    std::uint8_t mask = 0;
    for (std::size_t i = 0; i < points * bytes; ++i) {
      if (random.chance(0.05)) mask = static_cast<std::uint8_t>(random.below(256));
      masks[i] = mask;
    }
  }
};

void expect_list(const Case& c, std::size_t byte, int bit) {
  std::vector<std::uint32_t> expected;
  for (std::size_t i = 0; i < c.count; ++i) {
    if ((c.masks[i * c.stride + byte] >> bit & 1) != 0) expected.push_back(static_cast<std::uint32_t>(i));
  }
  std::size_t counts[8] = {};
  simd::count_wanted(c.masks.data() + byte, c.stride, c.count, counts);
  ASSERT_EQ(counts[bit], expected.size());

  WorkingMemory memory;
  simd::ListedPoints list = list_in(memory, expected.size());
  const simd::ListedBox box =
      simd::list_wanted({c.coordinates[0].data(), c.coordinates[1].data(), c.coordinates[2].data(), c.count},
                        {c.masks.data() + byte, c.stride, static_cast<std::uint8_t>(1u << bit)}, list);
  ASSERT_EQ(list.count, expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), list.numbers));
  const std::int32_t* const listed[3] = {list.x, list.y, list.z};
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(listed[k][i], c.coordinates[k][expected[i]]);
    if (expected.empty()) continue;
    EXPECT_EQ(box.lower[k], *std::min_element(listed[k], listed[k] + list.count));
    EXPECT_EQ(box.upper[k], *std::max_element(listed[k], listed[k] + list.count));
  }
}

TEST(ListedPoints, AreThoseWhoseBitIsSetOnEveryTarget) {
  Random random(20);
  for (const simd::Target target : simd::supported_targets()) {
    simd::set_active_target(target);
    for (const std::size_t count : {1u, 15u, 64u, 65u, 1000u, 4096u}) {
      for (const std::size_t stride : {1u, 3u}) {
        const Case c(count, stride, random);
        for (int bit = 0; bit < 8; ++bit) expect_list(c, stride - 1, bit);
      }
    }
  }
  simd::set_active_target(simd::supported_targets().back());
}

TEST(WorkingMemory, HoldsArraysApartAndIsKept) {
  WorkingMemory memory;
  memory.require(2 * SharedPages::room_for<std::uint32_t>(1000));
  const std::size_t held = memory.memory_bytes();
  std::uint32_t* const first = memory.take<std::uint32_t>(1000);
  std::uint32_t* const second = memory.take<std::uint32_t>(1000);
  EXPECT_EQ(memory.memory_bytes(), held);
  std::uint32_t* const large = memory.take<std::uint32_t>(1 << 20);  // more than there was
  std::fill_n(first, 1000, 1u);
  std::fill_n(second, 1000, 2u);
  std::fill_n(large, 1 << 20, 3u);
  EXPECT_EQ(std::count(first, first + 1000, 1u), 1000);
  EXPECT_EQ(std::count(second, second + 1000, 2u), 1000);
  const std::size_t all = memory.memory_bytes();
  EXPECT_GE(all, held + (std::size_t{1} << 22));
  for (int time = 0; time < 3; ++time) {
    memory.start();
    memory.take<std::uint32_t>(1000);
    memory.take<std::uint32_t>(1 << 20);
    memory.take<std::uint32_t>(1000);
  }
  EXPECT_EQ(memory.memory_bytes(), all);
}

}  // namespace
}  // namespace facemap
