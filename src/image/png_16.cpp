#include <facemap/error.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include "image/plane.h"
#include "image/png_chunks.h"
#include "parallel/executor.h"

namespace facemap {
namespace {

constexpr std::size_t kBandBytes = std::size_t{1} << 20;     ///< about, of rows that a thread compresses at a time
constexpr std::size_t kMostRowBytes = std::size_t{1} << 30;  ///< sizes of zlib have 32 bits
constexpr int kLevel = 4;  ///< of zlib: a third of the default's time for a tenth more bytes

/// zlib's compressor of a stream without its frame.
class Deflater {
 public:
  Deflater() {
    constexpr int kRaw = -15, kMemory = 8;
    if (deflateInit2(&stream_, kLevel, Z_DEFLATED, kRaw, kMemory, Z_FILTERED) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// Appends blocks that end at a whole byte, of bytes that fit a uInt.
  void compress(const std::vector<std::uint8_t>& bytes, bool is_last, std::vector<std::uint8_t>& out) {
    constexpr std::size_t kFlush = 16;  // bytes that a flush adds, more than enough
    const std::size_t begin = out.size();
    out.resize(begin + deflateBound(&stream_, bytes.size()) + kFlush);
    stream_.next_in = const_cast<Bytef*>(bytes.data());  // read alone
    stream_.avail_in = static_cast<uInt>(bytes.size());
    stream_.next_out = out.data() + begin;
    stream_.avail_out = static_cast<uInt>(out.size() - begin);
    deflate(&stream_, is_last ? Z_FINISH : Z_SYNC_FLUSH);
    out.resize(out.size() - stream_.avail_out);
  }

 private:
  z_stream stream_{};
};

int paeth(int left, int above, int corner) {
  const int to_left = std::abs(above - corner), to_above = std::abs(left - corner),
            to_corner = std::abs(left + above - 2 * corner);
  return to_left <= to_above && to_left <= to_corner ? left : to_above <= to_corner ? above : corner;
}

/// Rows as PNG has them, each with the filter of which the bytes are the smallest.
class RowFilter {
 public:
  explicit RowFilter(const PlaneView& plane, std::span<const std::uint16_t> levels)
      : levels_(levels),
        row_levels_(static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.channels)),
        pixel_bytes_(2 * static_cast<std::size_t>(plane.channels)),
        // A pixel of zeros is left of each row.
        above_(pixel_bytes_ + 2 * row_levels_),
        row_(above_.size()) {
    for (auto& filtered : filtered_) filtered.resize(1 + 2 * row_levels_);
  }

  std::size_t stride() const { return filtered_[0].size(); }

  void append(std::size_t first_row, std::size_t end_row, std::vector<std::uint8_t>& rows) {
    if (first_row > 0) load(first_row - 1);
    for (std::size_t y = first_row; y < end_row; ++y) {
      std::swap(above_, row_);
      if (y == 0) std::fill(above_.begin(), above_.end(), std::uint8_t{0});
      load(y);
      const std::vector<std::uint8_t>& best = filter();
      rows.insert(rows.end(), best.begin(), best.end());
    }
  }

 private:
  void load(std::size_t y) {
    std::uint8_t* to = row_.data() + pixel_bytes_;
    for (const std::uint16_t level : levels_.subspan(y * row_levels_, row_levels_)) {
      *to++ = static_cast<std::uint8_t>(level >> 8);
      *to++ = static_cast<std::uint8_t>(level);
    }
  }

  const std::vector<std::uint8_t>& filter() {
    std::size_t best = 0;
    std::uint64_t least = ~std::uint64_t{0};
    for (std::size_t k = 0; k < filtered_.size(); ++k) {
      const std::uint64_t sum = apply(kFilters[k], filtered_[k]);
      if (sum >= least) continue;
      least = sum;
      best = k;
    }
    return filtered_[best];
  }

  /// Returns the sum of the bytes' distances from 0.
  std::uint64_t apply(int filter, std::vector<std::uint8_t>& out) const {
    std::uint64_t sum = 0;
    out[0] = static_cast<std::uint8_t>(filter);
    for (std::size_t i = pixel_bytes_; i < row_.size(); ++i) {
      const int left = row_[i - pixel_bytes_], above = above_[i], corner = above_[i - pixel_bytes_];
      const int guess = filter == PNG_FILTER_VALUE_SUB  ? left
                        : filter == PNG_FILTER_VALUE_UP ? above
                                                        : paeth(left, above, corner);
      const auto rest = static_cast<std::uint8_t>(row_[i] - guess);
      out[1 + i - pixel_bytes_] = rest;
      sum += std::min<unsigned>(rest, 256u - rest);
    }
    return sum;
  }

  static constexpr std::array<int, 3> kFilters = {PNG_FILTER_VALUE_UP, PNG_FILTER_VALUE_SUB, PNG_FILTER_VALUE_PAETH};

  std::span<const std::uint16_t> levels_;
  std::size_t row_levels_, pixel_bytes_;
  std::vector<std::uint8_t> above_, row_;
  std::array<std::vector<std::uint8_t>, kFilters.size()> filtered_;
};

png::Band make_band(const PlaneView& plane, std::span<const std::uint16_t> levels, std::size_t first_row,
                    std::size_t end_row) {
  RowFilter filter(plane, levels);
  std::vector<std::uint8_t> rows;
  rows.reserve((end_row - first_row) * filter.stride());
  filter.append(first_row, end_row, rows);
  png::Band band;
  band.bytes = rows.size();
  band.adler = adler32_z(1, rows.data(), rows.size());
  png::begin_chunk(band.chunk, "IDAT");
  if (first_row == 0) band.chunk.insert(band.chunk.end(), {0x78, 0x9c});  // zlib's header: 32 KiB window, default
  const bool is_last = end_row == static_cast<std::size_t>(plane.height);
  Deflater().compress(rows, is_last, band.chunk);
  if (!is_last) png::finish_chunk(band.chunk, 0);
  return band;
}

}  // namespace

std::vector<std::uint8_t> encode_png_16(const PlaneView& plane, Transfer transfer, int threads) {
  constexpr int kColorTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                 PNG_COLOR_TYPE_RGB_ALPHA};
  const std::span<const std::uint16_t> levels = values_of<std::uint16_t>("PNG", plane, {1, 2, 3, 4});
  std::vector<std::uint8_t> bytes = png::begin_file(plane.width, plane.height, 16, kColorTypes[plane.channels - 1]);
  png::append_transfer(bytes, transfer);

  const auto height = static_cast<std::size_t>(plane.height);
  if (levels.size_bytes() / height > kMostRowBytes) throw Error("PNG: the image is too wide");
  const std::size_t rows = std::clamp<std::size_t>(kBandBytes / (levels.size_bytes() / height), 1, height);
  std::vector<png::Band> bands((height + rows - 1) / rows);
  const Executor executor(bands.size() == 1 ? 1 : threads);
  executor.for_each(bands.size(), [&](std::size_t i, int) {
    bands[i] = make_band(plane, levels, i * rows, std::min(height, (i + 1) * rows));
  });
  png::append_bands(bytes, bands);
  return bytes;
}

}  // namespace facemap
