#include "scene/repeats.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "parallel/executor.h"
#include "support/random.h"

namespace facemap {
namespace {

std::map<std::uint32_t, std::uint32_t> find(const std::vector<Key>& keys, int threads) {
  const Executor executor(threads);
  std::map<std::uint32_t, std::uint32_t> first_of;
  const auto key_of = [&](std::uint32_t i) { return keys[i]; };
  for (const Repeat& repeat : RepeatFinder(executor).find(keys.size(), key_of)) {
    EXPECT_TRUE(first_of.emplace(repeat.item, repeat.first).second) << "twice: " << repeat.item;
  }
  return first_of;
}

std::map<std::uint32_t, std::uint32_t> find_by_comparing(const std::vector<Key>& keys) {
  std::map<std::uint32_t, std::uint32_t> first_of;
  std::map<Key, std::uint32_t> seen;
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const auto [place, is_new] = seen.emplace(keys[i], i);
    if (!is_new) first_of[i] = place->second;
  }
  return first_of;
}

std::vector<Key> random_keys(int count, int range, Random& random) {
  std::vector<Key> keys(static_cast<std::size_t>(count));
  for (Key& key : keys) {
    for (std::uint32_t& index : key) index = static_cast<std::uint32_t>(random.below(range));
  }
  return keys;
}

TEST(Repeats, AgreeWithComparingAll) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<Key> keys = random_keys(random.below(300), 6, random);
    EXPECT_EQ(find(keys, 1), find_by_comparing(keys));
  }
}

TEST(Repeats, OfManyItemsAreTheSameForAnyNumberOfThreads) {
  Random random(0x5eed0030);
  for (const int range : {1, 20, 60, 1000}) {
    const std::vector<Key> keys = random_keys(100'000, range, random);
    const auto expected = find_by_comparing(keys);
    for (const int threads : {1, 2, 5}) EXPECT_EQ(find(keys, threads), expected) << range;
  }
}

// Made to be slow for the hash as it is: the product of the first two has one upper half, the third undoes the lower.
TEST(Repeats, OfKeysThatShareTheirHashAreFoundInTime) {
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15u, kUpper = 0x12345678u;
  std::uint64_t inverse = kFactor;  // Newton: each step doubles the number of right bits
  for (int i = 0; i < 5; ++i) inverse *= 2 - kFactor * inverse;
  ASSERT_EQ(kFactor * inverse, 1u);
  std::vector<Key> keys;
  for (std::uint64_t lower = 0; lower < 100'000; ++lower) {
    const std::uint64_t two = (kUpper << 32 | lower) * inverse;
    const Key key{static_cast<std::uint32_t>(two >> 32), static_cast<std::uint32_t>(two),
                  static_cast<std::uint32_t>(lower ^ kUpper)};
    keys.push_back(key);
    if (lower % 3 == 0) keys.push_back(key);
  }
  EXPECT_EQ(find(keys, 2), find_by_comparing(keys));
}

}  // namespace
}  // namespace facemap
