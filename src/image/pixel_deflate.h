#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace facemap {

/// Compresses rows of pixels as blocks of a DEFLATE stream (RFC 1951), faster than a compressor of just any bytes:
/// renders are flat runs and hard edges, so each pixel is looked for at its left, above it and where the same two
/// pixels stood last. Rows are as PNG has them: a filter byte of 0 and three bytes a pixel.
class PixelDeflater {
 public:
  /// Bytes behind the rows, and behind the output, that must be readable and writable.
  static constexpr std::size_t kPadding = 8;

  /// Appends a block, which ends at a whole byte and is the stream's last or not. If `has_row_above`, the decoder knows
  /// the row before rows[0], which stands there in memory, too.
  void compress(const std::uint8_t* rows, std::size_t row_count, std::size_t width, bool has_row_above, bool is_last,
                std::vector<std::uint8_t>& out);

 private:
  static constexpr int kLiterals = 286, kDistances = 30;  // symbols
  static constexpr std::size_t kHashSize = std::size_t{1} << 13;

  struct Code {
    std::uint32_t bits = 0;  ///< first bit lowest
    std::uint32_t length = 0;
  };

  void find_tokens(const std::uint8_t* rows, std::size_t row_count, std::size_t width, bool has_row_above);
  void add_literal(const std::uint8_t* pixel);
  void add_match(std::size_t pixels, std::size_t distance);
  std::uint8_t* write_header(std::uint8_t* at, bool is_last);
  std::uint8_t* write_tokens(std::uint8_t* at, std::size_t row_count, std::size_t width);
  std::size_t most_bytes(std::size_t row_count) const;

  std::vector<std::uint32_t> tokens_;  ///< a pixel's three bytes, or kMatch | (pixels - 1) << 16 | (distance - 1)
  std::array<std::uint32_t, kHashSize> last_place_{};
  std::array<std::uint32_t, kLiterals> literal_counts_{};
  std::array<std::uint32_t, kDistances> distance_counts_{};
  std::array<Code, kLiterals> literals_;
  std::array<Code, kDistances> distances_;
  std::vector<std::uint8_t> buffer_;
  std::uint64_t bits_ = 0;  ///< not yet written
  unsigned bit_count_ = 0;

  std::uint8_t* put(std::uint8_t* at, std::uint64_t bits, unsigned count);
};

}  // namespace facemap
