#include "scene/number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include "support/random.h"

namespace facemap {
namespace {

/// What scan_float makes of a whole word.
std::optional<float> scan(const std::string& word) {
  const std::string line = word + "\n" + std::string(kReadableBeyondEnd, '5');
  float value = -77;
  const char* const end = scan_float(line.c_str(), value);
  if (end == nullptr) return std::nullopt;
  EXPECT_EQ(end, line.c_str() + word.size()) << word;
  return value;
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// The C library rounds correctly; it takes infinite values where we take none.
void expect_as_strtof(const std::string& word) {
  const float expected = std::strtof(word.c_str(), nullptr);
  const std::optional<float> actual = scan(word);
  if (std::isinf(expected)) {
    EXPECT_FALSE(actual.has_value()) << word;
  } else {
    ASSERT_TRUE(actual.has_value()) << word;
    ASSERT_EQ(bits(*actual), bits(expected)) << word;
  }
}

std::string print(const char* format, double value) {
  char text[400];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string random_digits(Random& random, int count) {
  std::string digits;
  for (int i = 0; i < count; ++i) digits.push_back(static_cast<char>('0' + random.below(10)));
  return digits;
}

TEST(Number, TakesSignsPointsAndExponents) {
  EXPECT_EQ(scan("1"), 1.0f);
  EXPECT_EQ(scan("+1"), 1.0f);
  EXPECT_EQ(scan("-2."), -2.0f);
  EXPECT_EQ(scan("+.5"), 0.5f);
  EXPECT_EQ(scan("3.1e2"), 310.0f);
  EXPECT_EQ(scan("2.E-1"), 0.2f);
  EXPECT_EQ(scan("1e+007"), 1e7f);
  EXPECT_EQ(scan("00000000000000000000000000000000001.5"), 1.5f);
}

TEST(Number, RefusesWhatIsNoNumber) {
  for (const char* word : {"",     "+",    "-",        ".",      "+.",     "e5",   ".e5",    "1e",  "1e+",
                           "1e+x", "+-1",  "--1",      "1.2.3",  "1,5",    "0x10", "nan",    "NaN", "-nan",
                           "inf",  "-inf", "infinity", "1.#IND", "1.#INF", "1f",   "3.1+e2", "1/2", "1#"}) {
    EXPECT_FALSE(scan(word).has_value()) << word;
  }
}

TEST(Number, RefusesWhatIsTooLarge) {
  EXPECT_EQ(scan("3.4028235e38"), std::numeric_limits<float>::max());
  EXPECT_EQ(scan("3.40282356779733e38"), std::numeric_limits<float>::max());  // just below half-way to 2^128
  for (const char* word : {"3.40282356779734e38", "1e39", "-1e39", "1e400", "1e99999999999999999999"}) {
    EXPECT_FALSE(scan(word).has_value()) << word;
  }
  EXPECT_FALSE(scan("1" + std::string(50, '0')).has_value());
  EXPECT_FALSE(scan("0." + std::string(50, '0') + "1e100").has_value());
}

TEST(Number, MakesWhatIsTooSmallZeroOfItsSign) {
  for (const char* word : {"1e-46", "1e-400", "1e-99999999999999999999", "0e999999999999", "0.0000000"}) {
    ASSERT_TRUE(scan(word).has_value()) << word;
    EXPECT_EQ(bits(*scan(word)), bits(0.0f)) << word;
    EXPECT_EQ(bits(*scan(std::string("-") + word)), bits(-0.0f)) << word;
  }
  EXPECT_EQ(bits(*scan("0." + std::string(60, '0') + "1")), bits(0.0f));
  EXPECT_EQ(scan("1e-45"), std::numeric_limits<float>::denorm_min());
}

TEST(Number, RoundsAsTheLibraryDoesOnRandomWords) {
  constexpr std::uint64_t kSeed = 1;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random(kSeed);
  for (int i = 0; i < 1'500'000; ++i) {
    std::string word = random.chance(0.3) ? "-" : "";
    word += random_digits(random, random.below(random.chance(0.1) ? 30 : 9));
    if (random.chance(0.8)) word += "." + random_digits(random, random.below(random.chance(0.1) ? 40 : 9));
    if (word.find_first_of("0123456789") == std::string::npos) word += "7";
    if (random.chance(0.3)) word += "e" + std::to_string(random.between(-50, 45));
    expect_as_strtof(word);
    if (HasFatalFailure()) return;
  }
}

TEST(Number, RoundsAsTheLibraryDoesOnPrintedFloats) {
  constexpr std::uint64_t kSeed = 2;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random(kSeed);
  const char* const formats[] = {"%.6g", "%.9g", "%.17g", "%.6f", "%.8e", "%.3e", "%.12f"};
  for (int i = 0; i < 1'000'000; ++i) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
    if (!std::isfinite(value)) continue;
    expect_as_strtof(print(formats[random.below(7)], value));
    if (HasFatalFailure()) return;
  }
}

/// The points half-way between floats, and their neighbours one unit away in the last of many digits.
TEST(Number, RoundsTiesToEven) {
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random(kSeed);
  for (int i = 0; i < 300'000; ++i) {
    const auto low = std::bit_cast<float>(static_cast<std::uint32_t>(random.next() & 0x7fffffff));
    const float high = std::nextafter(low, std::numeric_limits<float>::infinity());
    if (!std::isfinite(low) || !std::isfinite(high)) continue;
    const double middle = (static_cast<double>(low) + high) / 2;
    expect_as_strtof(print("%.160g", middle));
    expect_as_strtof(print("%.17g", middle));
    expect_as_strtof(print("%.15g", middle));
    std::string beside = print("%.130e", middle);
    beside[beside.find('e') - 1] = random.chance(0.5) ? '1' : '0';
    expect_as_strtof(beside);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(scan("16777217"), 16777216.0f);
  EXPECT_EQ(scan("16777219"), 16777220.0f);
  EXPECT_EQ(scan("16777217.0000000000000001"), 16777218.0f);
  // 2^24 + 1 plus less than a double shows: rounding twice would give 16777216.
  EXPECT_EQ(scan("16777217.000000001"), 16777218.0f);
}

TEST(Number, IndexKeepsItsSignAndSaturates) {
  const auto index_of = [](const char* text) {
    std::int64_t index = 0;
    return scan_index(text, index) == nullptr ? std::int64_t{-1234} : index;
  };
  EXPECT_EQ(index_of("12/3"), 12);
  EXPECT_EQ(index_of("-7\n"), -7);
  EXPECT_EQ(index_of("+7\n"), 7);
  EXPECT_EQ(index_of("0\n"), 0);
  EXPECT_EQ(index_of("999999999999999999\n"), 999999999999999999);
  EXPECT_EQ(index_of("18446744073709551617\n"), kHugeIndex);
  EXPECT_EQ(index_of("-99999999999999999999999\n"), -kHugeIndex);
  EXPECT_EQ(index_of("x\n"), -1234);
  EXPECT_EQ(index_of("-\n"), -1234);
}

}  // namespace
}  // namespace facemap
