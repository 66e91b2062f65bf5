#include "image/pixel_deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "image/huffman.h"
#include "support/random.h"

namespace facemap {
namespace {

/// What zlib makes of a raw stream.
std::vector<std::uint8_t> inflated(std::vector<std::uint8_t> stream, std::size_t size) {
  std::vector<std::uint8_t> bytes(size + 1);
  z_stream zlib{};
  EXPECT_EQ(inflateInit2(&zlib, -15), Z_OK);
  zlib.next_in = stream.data();
  zlib.avail_in = static_cast<uInt>(stream.size());
  zlib.next_out = bytes.data();
  zlib.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&zlib, Z_FINISH), Z_STREAM_END) << (zlib.msg != nullptr ? zlib.msg : "");
  EXPECT_EQ(zlib.avail_in, 0u) << "bytes behind the stream's end";
  bytes.resize(zlib.total_out);
  inflateEnd(&zlib);
  return bytes;
}

/// Rows of PNG with room behind them.
std::vector<std::uint8_t> make_rows(std::size_t width, std::size_t height,
                                    const std::function<std::uint32_t()>& pixel) {
  std::vector<std::uint8_t> rows;
  for (std::size_t y = 0; y < height; ++y) {
    rows.push_back(0);
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint32_t rgb = pixel();
      for (int shift = 0; shift < 24; shift += 8) rows.push_back(static_cast<std::uint8_t>(rgb >> shift));
    }
  }
  rows.resize(rows.size() + PixelDeflater::kPadding, 0xee);
  return rows;
}

/// Compresses rows in blocks of so many and checks that zlib gives them back. Returns the compressed size.
std::size_t expect_back(const std::vector<std::uint8_t>& rows, std::size_t width, std::size_t height,
                        std::size_t block_rows) {
  PixelDeflater deflater;
  std::vector<std::uint8_t> stream;
  const std::size_t stride = 1 + 3 * width;
  for (std::size_t y = 0; y < height; y += block_rows) {
    const std::size_t end = std::min(height, y + block_rows);
    deflater.compress(rows.data() + y * stride, end - y, width, y > 0, end == height, stream);
  }
  const std::vector<std::uint8_t> wanted(rows.begin(), rows.end() - PixelDeflater::kPadding);
  EXPECT_TRUE(inflated(stream, wanted.size()) == wanted) << width << " x " << height;
  return stream.size();
}

TEST(PixelDeflate, GivesBackPicturesOfAllKinds) {
  Random random(20221122);
  std::uint32_t last = 0;
  const std::function<std::uint32_t()> kinds[] = {
      [] { return 0u; },
      [&] { return static_cast<std::uint32_t>(random.next() & 0xffffff); },
      [&] { return random.chance(0.9) ? last : last = static_cast<std::uint32_t>(random.next() & 0xffffff); },
      [&] { return static_cast<std::uint32_t>(random.next() & 1) * 0x010203; },
      [&] { return last = (last + 0x010001) & 0xffffff; },
      [&] { return std::uint32_t{0x40} << 8 * random.below(3); },
  };
  for (const auto& kind : kinds) {
    for (const auto& [width, height, block_rows] : {std::array<std::size_t, 3>{1, 1, 1},
                                                    {1, 100, 7},
                                                    {2, 2, 2},
                                                    {85, 9, 4},
                                                    {86, 9, 9},
                                                    {300, 70, 32},
                                                    {1000, 3, 1},
                                                    {10922, 5, 2},
                                                    {10923, 5, 2},
                                                    {20000, 4, 3}}) {
      expect_back(make_rows(width, height, kind), width, height, block_rows);
    }
  }
}

TEST(PixelDeflate, FlatPicturesBecomeSmall) {
  const std::vector<std::uint8_t> rows = make_rows(1024, 1024, [] { return 0x336699u; });
  EXPECT_LT(expect_back(rows, 1024, 1024, 85), 3u * 1024 * 1024 / 200);
}

TEST(PixelDeflate, NoiseGrowsByLittle) {
  Random random(7);
  const std::vector<std::uint8_t> rows =
      make_rows(500, 400, [&] { return static_cast<std::uint32_t>(random.next() & 0xffffff); });
  EXPECT_LT(expect_back(rows, 500, 400, 100), rows.size() + rows.size() / 50);
}

double kraft_sum(const std::vector<std::uint8_t>& lengths) {
  double sum = 0;
  for (const std::uint8_t length : lengths) sum += length > 0 ? 1.0 / static_cast<double>(1 << length) : 0;
  return sum;
}

TEST(Huffman, LengthsMakeACompletePrefixCode) {
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    const unsigned most = round % 2 == 0 ? 15 : 7;
    std::vector<std::uint32_t> counts(static_cast<std::size_t>(random.between(2, most == 7 ? 19 : 286)));
    for (std::uint32_t& count : counts) {
      count = static_cast<std::uint32_t>(random.next() >> random.between(32, 63));  // of all magnitudes
      if (random.chance(0.3)) count = 0;
    }
    counts[0] = counts[1] = 1;
    std::vector<std::uint8_t> lengths(counts.size());
    find_code_lengths(counts, most, lengths);
    EXPECT_EQ(kraft_sum(lengths), 1.0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      EXPECT_EQ(lengths[i] > 0, counts[i] > 0);
      EXPECT_LE(lengths[i], most);
    }
  }
}

TEST(Huffman, FewestBits) {
  std::vector<std::uint8_t> lengths(6);
  find_code_lengths(std::vector<std::uint32_t>{45, 13, 12, 16, 9, 5}, 15, lengths);
  EXPECT_EQ(lengths, (std::vector<std::uint8_t>{1, 3, 3, 3, 4, 4}));

  std::vector<std::uint32_t> fibonacci{1, 1};  // the deepest tree
  while (fibonacci.size() < 30) fibonacci.push_back(fibonacci.back() + fibonacci[fibonacci.size() - 2]);
  lengths.resize(fibonacci.size());
  find_code_lengths(fibonacci, 15, lengths);
  EXPECT_EQ(kraft_sum(lengths), 1.0);
  EXPECT_LE(*std::max_element(lengths.begin(), lengths.end()), 15);

  lengths.assign(3, 9);
  find_code_lengths(std::vector<std::uint32_t>{0, 8, 0}, 15, lengths);
  EXPECT_EQ(lengths, (std::vector<std::uint8_t>{0, 1, 0}));
  find_code_lengths(std::vector<std::uint32_t>{0, 0, 0}, 15, lengths);
  EXPECT_EQ(lengths, (std::vector<std::uint8_t>{0, 0, 0}));
}

}  // namespace
}  // namespace facemap
