#pragma once

#include <cstddef>
#include <cstdint>

namespace facemap::simd {

/// Points by their coordinates, integers.
struct PointArrays {
  const std::int32_t* x;
  const std::int32_t* y;
  const std::int32_t* z;
  std::size_t count;
};

/// A list of points, with room for kListPadding more.
struct ListedPoints {
  std::int32_t *x, *y, *z;
  std::uint32_t* numbers;  ///< among all points, ascending
  std::size_t count;
};

/// Vectors of the kernels may read and write this many elements past the end of a list.
inline constexpr std::size_t kListPadding = 64;

/// The box of the integers of points.
struct ListedBox {
  std::int32_t lower[3], upper[3];
};

/// Which points are asked: those i with (masks[i * stride] & bit) != 0.
struct WantedBits {
  const std::uint8_t* masks;
  std::size_t stride;
  std::uint8_t bit;
};

/// Adds to counts[b] how many of `count` points have bit b of masks[i * stride] set.
void count_wanted(const std::uint8_t* masks, std::size_t stride, std::size_t count, std::size_t* counts);

/// Lists those that are asked, for which `list` has room; sets its count.
ListedBox list_wanted(const PointArrays& points, const WantedBits& wanted, ListedPoints& list);

}  // namespace facemap::simd
