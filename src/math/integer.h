#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace facemap {

/// A signed integer of N limbs of 64 bits, least first, in two's complement: no allocation, every width known when
/// compiled. A product is as wide as its factors together and never overflows; a sum is as wide as the wider of its
/// terms, and it is the user who knows that it fits (see numbers.h).
template <int N>
struct Integer {
  std::array<std::uint64_t, N> limbs{};

  /// value * 2^shift; the result must fit.
  static Integer shifted(std::int64_t value, int shift) {
    Integer result;
    const int whole = shift / 64, part = shift % 64;
    const auto bits = static_cast<std::uint64_t>(value);
    const auto fill = static_cast<std::uint64_t>(value >> 63);
    for (int i = 0; i < N; ++i) {
      if (i == whole) result.limbs[i] = bits << part;
      if (i == whole + 1) result.limbs[i] = part == 0 ? fill : static_cast<std::uint64_t>(value >> (64 - part));
      if (i > whole + 1) result.limbs[i] = fill;
    }
    return result;
  }

  bool is_negative() const { return (limbs[N - 1] >> 63) != 0; }

  /// All bits set if negative, else 0: what stands above the last limb.
  std::uint64_t fill() const { return 0 - (limbs[N - 1] >> 63); }

  std::uint64_t limb(int i) const { return i < N ? limbs[i] : fill(); }

  int sign() const {
    std::uint64_t any = 0;
    for (const std::uint64_t limb : limbs) any |= limb;
    return is_negative() ? -1 : any != 0;
  }
};

__extension__ using DoubleLimb = unsigned __int128;
__extension__ using SignedDoubleLimb = __int128;

template <int A, int B>
Integer<std::max(A, B)> operator+(const Integer<A>& a, const Integer<B>& b) {
  Integer<std::max(A, B)> sum;
  std::uint64_t carry = 0;
  for (int i = 0; i < std::max(A, B); ++i) {
    const DoubleLimb s = DoubleLimb{a.limb(i)} + b.limb(i) + carry;
    sum.limbs[i] = static_cast<std::uint64_t>(s);
    carry = static_cast<std::uint64_t>(s >> 64);
  }
  return sum;
}

template <int A, int B>
Integer<std::max(A, B)> operator-(const Integer<A>& a, const Integer<B>& b) {
  Integer<std::max(A, B)> difference;
  std::uint64_t borrow = 0;
  for (int i = 0; i < std::max(A, B); ++i) {
    const DoubleLimb d = DoubleLimb{a.limb(i)} - b.limb(i) - borrow;
    difference.limbs[i] = static_cast<std::uint64_t>(d);
    borrow = static_cast<std::uint64_t>(d >> 64) & 1;
  }
  return difference;
}

template <int A>
Integer<A> operator-(const Integer<A>& a) {
  return Integer<A>{} - a;
}

// Takes `b & mask` from the limbs of `a` at `first` and above; what leaves at the top is dropped.
template <int A, int B>
void subtract_masked(Integer<A>& a, int first, const Integer<B>& b, std::uint64_t mask) {
  std::uint64_t borrow = 0;
  for (int i = 0; i < B; ++i) {
    const DoubleLimb d = DoubleLimb{a.limbs[first + i]} - (b.limbs[i] & mask) - borrow;
    a.limbs[first + i] = static_cast<std::uint64_t>(d);
    borrow = static_cast<std::uint64_t>(d >> 64) & 1;
  }
}

template <int A, int B>
Integer<A + B> operator*(const Integer<A>& a, const Integer<B>& b) {
  Integer<A + B> product;
  if constexpr (A == 1 && B == 1) {
    const SignedDoubleLimb p =
        SignedDoubleLimb{static_cast<std::int64_t>(a.limbs[0])} * static_cast<std::int64_t>(b.limbs[0]);
    product.limbs = {static_cast<std::uint64_t>(p), static_cast<std::uint64_t>(p >> 64)};
  } else {
    for (int i = 0; i < A; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < B; ++j) {
        const DoubleLimb p = DoubleLimb{a.limbs[i]} * b.limbs[j] + product.limbs[i + j] + carry;
        product.limbs[i + j] = static_cast<std::uint64_t>(p);
        carry = static_cast<std::uint64_t>(p >> 64);
      }
      product.limbs[i + B] = carry;
    }
    // Read without its sign, a negative factor is too large by 2^(64 width).
    subtract_masked(product, A, b, a.fill());
    subtract_masked(product, B, a, b.fill());
  }
  return product;
}

}  // namespace facemap
