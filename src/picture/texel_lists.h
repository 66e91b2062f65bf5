#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/listed_faces.h"

namespace facemap {

/// Numbers of faces for each texel of a raster, each with a depth of 16 bits and a bit for each spot of the texel that
/// the face may meet (simd/bounded_points.h). An entry has as many bits of the depth as the face leaves to it.
///
/// Memory: 6 bytes an entry and 2.25 a texel, and 12 bytes an entry while they are made.
class TexelLists {
 public:
  class Maker;

  int size() const noexcept { return size_; }  ///< texels a side
  bool any() const noexcept { return size_ > 0; }
  simd::ListBegins begins() const noexcept { return {begins_of_sixteen_.data(), begins_.data()}; }
  const std::uint32_t* entries() const noexcept { return entries_.data(); }
  const std::uint16_t* spots() const noexcept { return spots_.data(); }
  int face_bits() const noexcept { return face_bits_; }
  int depth_shift() const noexcept { return face_bits_ > 16 ? face_bits_ - 16 : 0; }
  std::size_t memory_bytes() const noexcept;

 private:
  int size_ = 0;
  int face_bits_ = 0;
  std::vector<std::uint32_t> begins_of_sixteen_;
  std::vector<std::uint16_t> begins_, spots_;
  std::vector<std::uint32_t> entries_;
};

/// Makes lists of entries that come in any order of texels.
class TexelLists::Maker {
 public:
  /// `faces`: numbers are below; no more than `most` entries are taken.
  Maker(int size, std::size_t faces, std::size_t most);

  /// False if it does not fit: there will be no lists.
  bool add(std::size_t texel, std::uint32_t face, std::uint32_t depth, unsigned spots) {
    if (waiting_.size() >= most_) return false;
    waiting_.push_back({static_cast<std::uint32_t>(texel), depth >> lists_.depth_shift() << lists_.face_bits_ | face,
                        static_cast<std::uint16_t>(spots)});
    return true;
  }

  /// None if texels have too many.
  TexelLists take();

 private:
  struct Waiting {
    std::uint32_t texel, entry;
    std::uint16_t spots;
  };

  std::size_t most_;
  TexelLists lists_;
  std::vector<Waiting> waiting_;
};

}  // namespace facemap
