#include "image/pixel_deflate.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#include "image/huffman.h"

namespace facemap {
namespace {

constexpr std::uint32_t kMatch = 0x80000000u;
constexpr std::size_t kMostPixels = 85;       // of a match: 255 bytes
constexpr std::size_t kMostDistance = 32768;  // bytes
constexpr unsigned kMostCodeBits = 15, kMostLengthCodeBits = 7;
constexpr int kEndOfBlock = 256;
constexpr std::uint32_t kNowhere = 0xffffffffu;

/// RFC 1951, 3.2.5: the symbol of a length or distance, and the bits that follow it.
struct Symbol {
  std::uint32_t symbol, extra, extra_bits;
};

/// Symbols after the first few double their range every `steps`; `offset` counts from 0.
Symbol symbol_of(std::uint32_t offset, unsigned log_steps) {
  const std::uint32_t steps = 1u << log_steps;
  if (offset < 2 * steps) return {offset, 0, 0};
  const auto bits = static_cast<unsigned>(std::bit_width(offset)) - log_steps - 1;
  return {bits * steps + (offset >> bits), offset & ((1u << bits) - 1), bits};
}

/// `bytes`: 3 to 257, of which the symbol's range ends at 258.
Symbol length_symbol(std::size_t bytes) {
  Symbol s = symbol_of(static_cast<std::uint32_t>(bytes - 3), 2);
  s.symbol += kEndOfBlock + 1;
  return s;
}

Symbol distance_symbol(std::size_t distance) { return symbol_of(static_cast<std::uint32_t>(distance - 1), 1); }

/// How many bytes are equal, `most` at most; 7 more must be readable.
std::size_t equal_bytes(const std::uint8_t* a, const std::uint8_t* b, std::size_t most) {
  for (std::size_t i = 0; i < most; i += 8) {
    std::uint64_t x, y;
    std::memcpy(&x, a + i, 8);
    std::memcpy(&y, b + i, 8);
    if (x != y) return std::min(most, i + static_cast<std::size_t>(std::countr_zero(x ^ y)) / 8);
  }
  return most;
}

/// Of two pixels.
std::uint64_t six_bytes(const std::uint8_t* at) {
  std::uint64_t bytes;
  std::memcpy(&bytes, at, 8);
  return bytes << 16;
}

/// Canonical codes of these lengths, as they are sent: first bit lowest. RFC 1951, 3.2.2.
template <class Code>
void assign_codes(std::span<const std::uint8_t> lengths, std::span<Code> codes) {
  std::uint32_t counts[kMostCodeBits + 1] = {}, next[kMostCodeBits + 1] = {};
  for (const std::uint8_t length : lengths) ++counts[length];
  counts[0] = 0;  // what has no code
  for (unsigned n = 1; n <= kMostCodeBits; ++n) next[n] = (next[n - 1] + counts[n - 1]) << 1;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const unsigned n = lengths[i];
    codes[i] = {};
    if (n == 0) continue;
    const std::uint32_t code = next[n]++;
    for (unsigned bit = 0; bit < n; ++bit) codes[i].bits |= (code >> bit & 1) << (n - 1 - bit);
    codes[i].length = n;
  }
}

}  // namespace

void PixelDeflater::compress(const std::uint8_t* rows, std::size_t row_count, std::size_t width, bool has_row_above,
                             bool is_last, std::vector<std::uint8_t>& out) {
  find_tokens(rows, row_count, width, has_row_above);
  buffer_.resize(most_bytes(row_count));
  std::uint8_t* end = write_header(buffer_.data(), is_last);
  end = write_tokens(end, row_count, width);
  if (!is_last) {
    end = put(end, 0, 3);  // an empty stored block fills the byte
    end = put(end, 0, (8 - bit_count_ % 8) % 8);
    end = put(end, 0xffff0000u, 32);
  }
  end = put(end, 0, (8 - bit_count_ % 8) % 8);
  out.insert(out.end(), buffer_.data(), end);
}

std::uint8_t* PixelDeflater::put(std::uint8_t* at, std::uint64_t bits, unsigned count) {
  bits_ |= bits << bit_count_;
  bit_count_ += count;
  std::memcpy(at, &bits_, 8);
  const unsigned bytes = bit_count_ / 8;
  bits_ >>= 8 * bytes;  // of less than 8: 7 bits are left and 48 come at most
  bit_count_ %= 8;
  return at + bytes;
}

void PixelDeflater::add_literal(const std::uint8_t* pixel) {
  for (int i = 0; i < 3; ++i) ++literal_counts_[pixel[i]];
  tokens_.push_back(pixel[0] | std::uint32_t{pixel[1]} << 8 | std::uint32_t{pixel[2]} << 16);
}

void PixelDeflater::add_match(std::size_t pixels, std::size_t distance) {
  ++literal_counts_[length_symbol(3 * pixels).symbol];
  ++distance_counts_[distance_symbol(distance).symbol];
  tokens_.push_back(kMatch | static_cast<std::uint32_t>((pixels - 1) << 16 | (distance - 1)));
}

void PixelDeflater::find_tokens(const std::uint8_t* rows, std::size_t row_count, std::size_t width,
                                bool has_row_above) {
  const std::size_t stride = 3 * width + 1;
  tokens_.clear();
  literal_counts_.fill(0);
  distance_counts_.fill(0);
  last_place_.fill(kNowhere);
  literal_counts_[kEndOfBlock] = 1;
  literal_counts_[0] = static_cast<std::uint32_t>(row_count);  // the filter bytes
  for (std::size_t y = 0; y < row_count; ++y) {
    const std::uint8_t* at = rows + y * stride + 1;
    const std::uint8_t* const end = at + 3 * width;
    const bool looks_above = (y > 0 || has_row_above) && stride <= kMostDistance;
    bool has_left = false;
    while (at != end) {
      const std::size_t most = std::min<std::size_t>(3 * kMostPixels, static_cast<std::size_t>(end - at));
      std::size_t length = has_left ? equal_bytes(at, at - 3, most) : 0, distance = 3;
      has_left = true;
      if (looks_above && length < most) {
        const std::size_t above = equal_bytes(at, at - stride, most);
        if (above > length) length = above, distance = stride;
      }
      const auto place = static_cast<std::uint32_t>(at - rows);
      if (length < 6 && most >= 6) {
        std::uint32_t& last = last_place_[six_bytes(at) * 0x9e3779b97f4a7c15u >> 51];
        if (last != kNowhere && place - last <= kMostDistance) {
          const std::size_t there = equal_bytes(at, rows + last, most);
          if (there >= 6) length = there, distance = place - last;
        }
        last = place;
      }
      if (length >= 3) {
        add_match(length / 3, distance);
        at += length / 3 * 3;
      } else {
        add_literal(at);
        at += 3;
      }
    }
  }
}

std::uint8_t* PixelDeflater::write_header(std::uint8_t* at, bool is_last) {
  std::array<std::uint8_t, kLiterals + kDistances> lengths;
  const std::span<std::uint8_t> literals(lengths.data(), kLiterals), distances(lengths.data() + kLiterals, kDistances);
  find_code_lengths(literal_counts_, kMostCodeBits, literals);
  find_code_lengths(distance_counts_, kMostCodeBits, distances);
  assign_codes<Code>(literals, literals_);
  assign_codes<Code>(distances, distances_);

  // RFC 1951, 3.2.7: the lengths above are themselves sent in a code, whose lengths come first, in this order.
  constexpr std::uint8_t kOrder[] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  std::array<std::uint32_t, std::size(kOrder)> counts{};
  std::array<std::uint8_t, std::size(kOrder)> length_lengths;
  std::array<Code, std::size(kOrder)> length_codes;
  for (const std::uint8_t length : lengths) ++counts[length];
  find_code_lengths(counts, kMostLengthCodeBits, length_lengths);
  assign_codes<Code>(length_lengths, length_codes);

  at = put(at, is_last, 1);
  at = put(at, 2, 2);  // a block with codes of its own
  at = put(at, kLiterals - 257, 5);
  at = put(at, kDistances - 1, 5);
  at = put(at, std::size(kOrder) - 4, 4);
  for (const std::uint8_t symbol : kOrder) at = put(at, length_lengths[symbol], 3);
  for (const std::uint8_t length : lengths) at = put(at, length_codes[length].bits, length_codes[length].length);
  return at;
}

std::uint8_t* PixelDeflater::write_tokens(std::uint8_t* at, std::size_t row_count, std::size_t width) {
  std::array<Code, kMostPixels + 1> lengths;  // with the bits that follow
  for (std::size_t pixels = 1; pixels <= kMostPixels; ++pixels) {
    const Symbol s = length_symbol(3 * pixels);
    const Code& code = literals_[s.symbol];
    lengths[pixels] = {code.bits | s.extra << code.length, code.length + s.extra_bits};
  }
  const std::uint32_t* token = tokens_.data();
  for (std::size_t y = 0; y < row_count; ++y) {
    at = put(at, literals_[0].bits, literals_[0].length);
    for (std::size_t x = 0; x < width; ++token) {
      std::uint64_t bits;
      unsigned count;
      if (*token & kMatch) {
        const std::size_t pixels = (*token >> 16 & 0x7f) + 1;
        const Symbol s = distance_symbol((*token & 0xffff) + 1);
        const Code& length = lengths[pixels];
        const Code& code = distances_[s.symbol];
        bits = length.bits | std::uint64_t{code.bits} << length.length |
               std::uint64_t{s.extra} << (length.length + code.length);
        count = length.length + code.length + s.extra_bits;
        x += pixels;
      } else {
        const Code &r = literals_[*token & 0xff], &g = literals_[*token >> 8 & 0xff], &b = literals_[*token >> 16];
        bits = r.bits | std::uint64_t{g.bits} << r.length | std::uint64_t{b.bits} << (r.length + g.length);
        count = r.length + g.length + b.length;
        ++x;
      }
      at = put(at, bits, count);
    }
  }
  return put(at, literals_[kEndOfBlock].bits, literals_[kEndOfBlock].length);
}

/// Of all tokens with the longest codes, the header and the end.
std::size_t PixelDeflater::most_bytes(std::size_t row_count) const {
  constexpr std::size_t kMostTokenBytes = 7, kHeaderBytes = 512;  // a token: 3 * 15, or 15 + 5 + 15 + 13 bits
  return kMostTokenBytes * tokens_.size() + 2 * row_count + kHeaderBytes + kPadding;
}

}  // namespace facemap
