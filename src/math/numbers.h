#pragma once

#include <facemap/vector.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "math/integer.h"
#include "math/tracked.h"
#include "math/vec3.h"

/// The kinds of numbers that float32 inputs are turned into. Each kind has the same three functions, so that an
/// expression (expressions.h) is written once. Expressions are homogeneous in lengths and in directions apart: a kind
/// may measure each in a unit of its own.
namespace facemap {

/// Plain doubles; each expression comes with its bound (plain_signs.cpp).
struct PlainNumbers {
  Vec3<double> difference(const Vector& a, const Vector& b) const {
    return {double(a.x) - double(b.x), double(a.y) - double(b.y), double(a.z) - double(b.z)};
  }
  Vec3<double> direction(const Vector& d) const { return {double(d.x), double(d.y), double(d.z)}; }
  double length(float x) const { return double(x); }
};

/// Doubles that carry a bound of their own error.
struct TrackedNumbers {
  Vec3<Tracked> difference(const Vector& a, const Vector& b) const {
    return {Tracked::difference(a.x, b.x), Tracked::difference(a.y, b.y), Tracked::difference(a.z, b.z)};
  }
  Vec3<Tracked> direction(const Vector& d) const {
    return {Tracked::exact(d.x), Tracked::exact(d.y), Tracked::exact(d.z)};
  }
  Tracked length(float x) const { return Tracked::exact(x); }
};

/// Which powers of two the bits of some floats stand for. A float32 other than 0 is an integer below 2^24 in magnitude
/// times 2^(e - 150), e its exponent field, 1 for denormals.
class ExponentRange {
 public:
  static constexpr int kUnitOfField = 150;

  template <class... Vectors>
  static ExponentRange of(const Vectors&... vectors) {
    ExponentRange range;
    (range.include(vectors), ...);
    return range;
  }

  void include(const Vector& v) {
    include(v.x);
    include(v.y);
    include(v.z);
  }

  void include(float x) {
    const std::uint32_t magnitude = std::bit_cast<std::uint32_t>(x) & 0x7fffffffu;
    greatest_ = std::max(greatest_, magnitude);
    least_less_one_ = std::min(least_less_one_, magnitude - 1);  // wraps round for 0, which any unit measures
  }

  /// In units of 2^(lowest() - 150) every float included is an integer, below 2^bits() in magnitude.
  int lowest() const { return least_less_one_ == kNone ? 1 : field_of(least_less_one_ + 1); }
  int bits() const { return field_of(greatest_) - lowest() + 24; }

  /// Of the bits of a float without its sign.
  static int field_of(std::uint32_t magnitude) { return std::max(1, static_cast<int>(magnitude >> 23)); }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t greatest_ = 0;
  std::uint32_t least_less_one_ = kNone;
};

/// Integers of N limbs for each input, exact. An input is below 2^(64 N - 3), so a difference of two is below
/// 2^(64 N - 2). An expression of degree k is a sum of m products of k of these: |value| < m 2^(64 N k - 2 k). It has
/// N k limbs, hence fits if m <= 2^(2 k - 1). Here m is at most 1, 2, 6, 12, 24, 72, 144 for k = 1 to 7.
template <int N>
class IntegerNumbers {
 public:
  static constexpr int kMostBits = 64 * N - 3;

  IntegerNumbers(int lowest_length, int lowest_direction)
      : lowest_length_(lowest_length), lowest_direction_(lowest_direction) {}

  Vec3<Integer<N>> difference(const Vector& a, const Vector& b) const {
    return Vec3{length(a.x), length(a.y), length(a.z)} - Vec3{length(b.x), length(b.y), length(b.z)};
  }
  Vec3<Integer<N>> direction(const Vector& d) const {
    return {number(d.x, lowest_direction_), number(d.y, lowest_direction_), number(d.z, lowest_direction_)};
  }
  Integer<N> length(float x) const { return number(x, lowest_length_); }

 private:
  static Integer<N> number(float x, int lowest) {
    if constexpr (N == 1) {
      // 2^(150 - lowest) in double; the product is exact, and an integer.
      const auto unit =
          std::bit_cast<double>(static_cast<std::uint64_t>(1023 + ExponentRange::kUnitOfField - lowest) << 52);
      return {{static_cast<std::uint64_t>(static_cast<std::int64_t>(double(x) * unit))}};
    } else {
      const std::uint32_t magnitude = std::bit_cast<std::uint32_t>(x) & 0x7fffffffu;
      if (magnitude == 0) return {};
      const std::int64_t fraction = magnitude & 0x7fffffu;
      const std::int64_t mantissa = magnitude < 0x800000u ? fraction : fraction | 0x800000;
      return Integer<N>::shifted(x < 0 ? -mantissa : mantissa, ExponentRange::field_of(magnitude) - lowest);
    }
  }

  int lowest_length_, lowest_direction_;
};

/// Calls expression(numbers) with integers wide enough for these inputs: one limb for those within a factor of 2^37 of
/// each other, which nearly all scenes are, two for 2^101, else five, which hold any floats (254 - 1 + 24 bits).
template <class Expression>
auto in_integers(const ExponentRange& lengths, const ExponentRange& directions, const Expression& expression) {
  const int bits = std::max(lengths.bits(), directions.bits());
  const int length = lengths.lowest(), direction = directions.lowest();
  if (bits <= IntegerNumbers<1>::kMostBits) return expression(IntegerNumbers<1>(length, direction));
  if (bits <= IntegerNumbers<2>::kMostBits) return expression(IntegerNumbers<2>(length, direction));
  return expression(IntegerNumbers<5>(length, direction));
}

}  // namespace facemap
