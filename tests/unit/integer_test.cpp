#include "math/integer.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "support/random.h"

namespace {

using facemap::Integer;

template <int N>
mpz_class gmp(const Integer<N>& value) {
  mpz_class result = static_cast<long>(static_cast<std::int64_t>(value.limbs[N - 1]));
  for (int i = N - 2; i >= 0; --i) result = (result << 64) + static_cast<unsigned long>(value.limbs[i]);
  return result;
}

// Limbs of every pattern that carries and signs depend on.
template <int N>
Integer<N> any(Random& random) {
  Integer<N> result;
  for (std::uint64_t& limb : result.limbs) {
    const std::uint64_t patterns[] = {
        0, 1, ~std::uint64_t{0}, std::uint64_t{1} << 63, (~std::uint64_t{0}) >> 1, random.next(), random.next()};
    limb = patterns[random.below(7)];
  }
  return result;
}

// What N limbs keep of a number.
template <int N>
mpz_class wrapped(const mpz_class& value) {
  const mpz_class range = mpz_class(1) << (64 * N);
  mpz_class result;
  mpz_mod(result.get_mpz_t(), value.get_mpz_t(), range.get_mpz_t());
  return result >= range / 2 ? mpz_class(result - range) : result;
}

template <int A, int B>
void compare_with_gmp(Random& random) {
  constexpr int kWider = A > B ? A : B;
  for (int i = 0; i < 20000; ++i) {
    const Integer<A> a = any<A>(random);
    const Integer<B> b = any<B>(random);
    const mpz_class x = gmp(a), y = gmp(b);
    ASSERT_EQ(gmp(a * b), x * y) << A << " limbs times " << B;
    ASSERT_EQ(gmp(a + b), wrapped<kWider>(x + y));
    ASSERT_EQ(gmp(a - b), wrapped<kWider>(x - y));
    ASSERT_EQ(gmp(-a), wrapped<A>(-x));
    ASSERT_EQ(a.sign(), sgn(x));
  }
}

TEST(Integer, ArithmeticEqualsGmp) {
  Random random(0x5eed0302);
  compare_with_gmp<1, 1>(random);
  compare_with_gmp<1, 2>(random);
  compare_with_gmp<2, 1>(random);
  compare_with_gmp<2, 2>(random);
  compare_with_gmp<3, 1>(random);
  compare_with_gmp<2, 4>(random);
  compare_with_gmp<5, 5>(random);
  compare_with_gmp<10, 20>(random);
}

TEST(Integer, ShiftsPlaceEveryBit) {
  Random random(0x5eed0303);
  for (int i = 0; i < 2000; ++i) {
    const int value = random.between(-(1 << 24), 1 << 24), shift = random.between(0, 290);
    ASSERT_EQ(gmp(Integer<5>::shifted(value, shift)), mpz_class(value) * (mpz_class(1) << shift));
    ASSERT_EQ(gmp(Integer<1>::shifted(value, shift % 38)), mpz_class(value) * (mpz_class(1) << (shift % 38)));
  }
}

}  // namespace
