#include "picture/texel_lists.h"

#include <bit>
#include <limits>

#include "picture/bytes_of.h"

namespace facemap {
namespace {

// Kernels read so many entries past the end.
constexpr std::size_t kPadding = 16;

// What is left of an entry holds the depth.
constexpr int kMostFaceBits = 26;

}  // namespace

std::size_t TexelLists::memory_bytes() const noexcept {
  return bytes_of(begins_of_sixteen_) + bytes_of(begins_) + bytes_of(spots_) + bytes_of(entries_);
}

TexelLists::Maker::Maker(int size, std::size_t faces, std::size_t most) : most_(most) {
  lists_.size_ = size;
  lists_.face_bits_ = static_cast<int>(std::bit_width(faces));
  if (lists_.face_bits_ > kMostFaceBits) most_ = 0;
}

TexelLists TexelLists::Maker::take() {
  const std::size_t texels = static_cast<std::size_t>(lists_.size_) * static_cast<std::size_t>(lists_.size_);
  std::vector<std::uint32_t> begins(texels + 1, 0);
  for (const Waiting& w : waiting_) ++begins[w.texel];
  lists_.begins_.resize(texels + 1);
  lists_.begins_of_sixteen_.reserve(texels / simd::ListBegins::kTexels + 1);
  std::uint32_t sum = 0;
  for (std::size_t t = 0; t <= texels; ++t) {
    const std::uint32_t count = begins[t];
    begins[t] = sum;
    if (t % simd::ListBegins::kTexels == 0) lists_.begins_of_sixteen_.push_back(sum);
    const std::uint32_t from_there = sum - lists_.begins_of_sixteen_.back();
    if (from_there > std::numeric_limits<std::uint16_t>::max()) return {};
    lists_.begins_[t] = static_cast<std::uint16_t>(from_there);
    sum += count;
  }
  lists_.entries_.resize(waiting_.size() + kPadding);
  lists_.spots_.resize(waiting_.size() + kPadding);
  for (const Waiting& w : waiting_) {
    const std::uint32_t place = begins[w.texel]++;
    lists_.entries_[place] = w.entry;
    lists_.spots_[place] = w.spots;
  }
  waiting_ = {};
  return std::move(lists_);
}

}  // namespace facemap
