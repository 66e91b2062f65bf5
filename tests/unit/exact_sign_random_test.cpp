// Every predicate of exact_sign.h beside the same sign in GMP integers, on inputs that each stage has to decide.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>

#include "math/exact_sign.h"
#include "support/sign_inputs.h"

namespace {

using facemap::Counters;
using facemap::GivenPoint;
using facemap::Triangle;
using facemap::TruePoint;
using facemap::Vector;
using sign_inputs::Inputs;
using sign_inputs::Kind;

constexpr std::uint64_t kSeed = 0x5eed0301;

// ---- the referee: rational points in GMP ------------------------------------------------------------------

struct Big {
  mpz_class x, y, z;
};

// In units of 2^-149.
mpz_class big(float value) {
  int exponent = 0;
  const float fraction = std::frexp(value, &exponent);  // value = fraction 2^exponent
  mpz_class result = static_cast<long>(std::ldexp(fraction, 24));
  const int shift = exponent - 24 + 149;
  if (shift >= 0) return result << static_cast<unsigned long>(shift);
  return result >> static_cast<unsigned long>(-shift);  // denormals: the bits shifted out are 0
}

Big big(const Vector& v) { return {big(v.x), big(v.y), big(v.z)}; }
Big minus(const Big& a, const Big& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Big times(const mpz_class& s, const Big& a) { return {s * a.x, s * a.y, s * a.z}; }
Big plus(const Big& a, const Big& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
mpz_class inner(const Big& a, const Big& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Big outer(const Big& a, const Big& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
mpz_class volume(const Big& a, const Big& b, const Big& c) { return inner(outer(a, b), c); }

// The point X / w, w > 0.
struct Point {
  Big X;
  mpz_class w;
};

struct Face {
  Big a, b, c;
  explicit Face(const Triangle& f) : a(big(f[0])), b(big(f[1])), c(big(f[2])) {}
  Big normal() const { return outer(minus(b, a), minus(c, a)); }
};

int side(const Triangle& face, const Vector& O) {
  const Face f(face);
  const Big o = big(O);
  return sgn(volume(minus(f.a, o), minus(f.b, o), minus(f.c, o)));
}

facemap::Covering covers(const Triangle& face, int s, const Big& o, const Big& d) {
  const Face f(face);
  const Big a = minus(f.a, o), b = minus(f.b, o), c = minus(f.c, o);
  const int x = s * sgn(volume(a, b, d)), y = s * sgn(volume(b, c, d)), z = s * sgn(volume(c, a, d));
  const bool hit = s != 0 && sgn(inner(d, d)) != 0 && x >= 0 && y >= 0 && z >= 0;
  return {hit, hit && x > 0 && y > 0 && z > 0};
}

Point true_point(const TruePoint& p) {
  const Face f(p.face);
  const Big n = f.normal(), k = big(p.K), d = big(p.d);
  mpz_class w = inner(n, d);
  Big X = plus(times(w, k), times(mpz_class(inner(n, minus(f.a, k))), d));
  if (p.s < 0) {
    w = -w;
    X = times(-1, X);
  }
  return {X, w};
}

Point given_point(const GivenPoint& p) {
  if (p.on_face == nullptr) return {big(p.P), 1};
  const Face f(*p.on_face);
  const Big n = f.normal(), P = big(p.P);
  const mpz_class w = inner(n, n);
  return {minus(times(w, P), times(mpz_class(inner(n, minus(P, f.a))), n)), w};
}

bool blocks(const Triangle& G, int s, const Vector& L, const Point& p) {
  const Face f(G);
  const Big D = minus(p.X, times(p.w, big(L)));
  const mpz_class beyond = inner(f.normal(), minus(p.X, times(p.w, f.a)));
  if (s * sgn(beyond) <= 0) return false;
  const Big l = big(L), a = minus(f.a, l), b = minus(f.b, l), c = minus(f.c, l);
  return s * sgn(volume(a, b, D)) >= 0 && s * sgn(volume(b, c, D)) >= 0 && s * sgn(volume(c, a, D)) >= 0;
}

bool is_outside(const Triangle& G, const Vector& P, float tolerance) {
  const Face f(G);
  const Big n = f.normal();
  const mpz_class height = inner(n, minus(big(P), f.a)), e = big(tolerance);
  return height * height > e * e * inner(n, n);
}

// t1 - t2 with t = delta / (n . d)
int compare_depth(const Triangle& face1, const Triangle& face2, const Vector& O, const Big& direction) {
  const Face f(face1), g(face2);
  const Big o = big(O), n = f.normal(), m = g.normal();
  const mpz_class w = inner(n, direction), v = inner(m, direction);
  return sgn(w) * sgn(v) * sgn(mpz_class(inner(n, minus(f.a, o)) * v - inner(m, minus(g.a, o)) * w));
}

int rounds() {
  const char* queries = std::getenv("FACEMAP_QUERIES");
  return queries != nullptr ? std::atoi(queries) : 20000;
}

class ExactSignKinds : public testing::TestWithParam<int> {
 protected:
  Inputs inputs{static_cast<Kind>(GetParam()), kSeed + static_cast<std::uint64_t>(GetParam())};
  Counters counters;
};

TEST_P(ExactSignKinds, SidesAndHitsEqualGmp) {
  int hits = 0;
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle();
    const Vector O = inputs.near(f), d = Inputs::finite(inputs.near(f) - O);
    const int s = side(f, O);
    ASSERT_EQ(facemap::side(f, O, &counters), s) << "round " << i << ", seed " << kSeed;
    const facemap::Covering expected = covers(f, s, big(O), big(d)), got = facemap::covers(f, s, O, d, &counters);
    ASSERT_EQ(got.hit, expected.hit) << "round " << i << ", seed " << kSeed;
    ASSERT_EQ(got.strictly_inside, expected.strictly_inside) << "round " << i << ", seed " << kSeed;
    const Face g(f);
    ASSERT_EQ(facemap::is_degenerate(f[0], f[1], f[2]), sgn(inner(g.normal(), g.normal())) == 0);
    hits += expected.hit;
  }
  EXPECT_GT(hits, rounds() / 100);
  EXPECT_GT(counters.by_exact, 0u);
  EXPECT_GT(counters.by_double, 0u);
}

TEST_P(ExactSignKinds, DepthsEqualGmp) {
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), g = inputs.neighbour(f);
    const Vector O = inputs.near(f), d = Inputs::finite(inputs.near(f) - O);
    const auto sign_of_slope = [&](const Triangle& t) { return sgn(inner(Face(t).normal(), big(d))); };
    // For a face that is hit the side has the sign of n . d.
    const int s1 = sign_of_slope(f), s2 = sign_of_slope(g);
    if (s1 == 0 || s2 == 0) continue;
    ASSERT_EQ(facemap::compare_depth(f, s1, g, s2, O, d, &counters), compare_depth(f, g, O, big(d)))
        << "round " << i << ", seed " << kSeed;
  }
  EXPECT_GT(counters.by_exact, 0u);
}

TEST_P(ExactSignKinds, DepthsTowardsPointsEqualGmp) {
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), g = inputs.neighbour(f);
    const Vector O = inputs.near(f), P = inputs.near(f);
    const Big d = minus(big(P), big(O));
    const int s1 = sgn(inner(Face(f).normal(), d)), s2 = sgn(inner(Face(g).normal(), d));
    if (s1 == 0 || s2 == 0) continue;
    ASSERT_EQ(facemap::compare_depth_towards(f, s1, g, s2, O, P, &counters), compare_depth(f, g, O, d))
        << "round " << i << ", seed " << kSeed;
    const facemap::Tracked t = facemap::segment_parameter(f, O, P);
    if (!std::isfinite(t.error) || std::fabs(t.value) > 0x1p300) continue;
    mpq_class truth(inner(Face(f).normal(), minus(big(f[0]), big(O))), inner(Face(f).normal(), d));
    truth.canonicalize();
    ASSERT_LE(abs(truth - mpq_class(t.value)), mpq_class(t.error * (1 + 0x1p-40)))
        << "round " << i << ", seed " << kSeed;
  }
  EXPECT_GT(counters.by_exact, 0u);
}

TEST_P(ExactSignKinds, BlockersOfTruePointsEqualGmp) {
  int asked = 0, blocked = 0;
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), G = inputs.neighbour(f);
    const Vector K = inputs.near(G), d = Inputs::finite(inputs.near(f) - K), L = inputs.near(f);
    const int slope = sgn(inner(Face(f).normal(), big(d))), s_G = side(G, L);
    if (slope == 0) continue;
    const TruePoint p{K, d, f, slope};
    const bool expected = s_G != 0 && blocks(G, s_G, L, true_point(p));
    ASSERT_EQ(facemap::blocks(G, s_G, L, p, &counters), expected) << "round " << i << ", seed " << kSeed;
    bool reaches = false;
    for (const Vector& corner : f) reaches = reaches || s_G * side(G, corner) < 0;
    ASSERT_EQ(facemap::reaches_beyond(f, G, s_G), reaches) << "round " << i << ", seed " << kSeed;
    if (expected && covers(f, slope, big(K), big(d)).hit) {
      ASSERT_TRUE(reaches) << "round " << i << ", seed " << kSeed;
    }
    ++asked;
    blocked += expected;
  }
  EXPECT_GT(asked, rounds() / 10);
  EXPECT_GT(blocked, asked / 1000);
  EXPECT_GT(counters.by_exact, 0u);
}

TEST_P(ExactSignKinds, BlockersOfGivenPointsEqualGmp) {
  int blocked = 0;
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), G = inputs.neighbour(f);
    const Vector L = inputs.near(f);
    GivenPoint p{inputs.near(f)};
    const int variant = inputs.below(3);
    if (variant == 1 && !facemap::is_degenerate(f[0], f[1], f[2])) p.on_face = &f;
    if (variant == 2) p.tolerance = std::fabs(inputs.coordinate());
    const int s_G = side(G, L);
    bool expected = s_G != 0 && blocks(G, s_G, L, given_point(p));
    if (p.tolerance > 0) expected = expected && is_outside(G, p.P, p.tolerance);
    ASSERT_EQ(facemap::blocks(G, s_G, L, p, &counters), expected) << "round " << i << ", seed " << kSeed;
    blocked += expected;
  }
  EXPECT_GT(blocked, 0);
  EXPECT_GT(counters.by_exact, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, ExactSignKinds, testing::Range(0, static_cast<int>(Kind::kCount)));

}  // namespace
