// Every predicate of parallel_signs.h beside the referee's answer, on inputs that each stage has to decide.

#include <gtest/gtest.h>

#include <cstdlib>

#include "math/parallel_signs.h"
#include "support/parallel_oracle.h"
#include "support/sign_inputs.h"

namespace {

using facemap::Counters;
using facemap::Covering;
using facemap::GivenPoint;
using facemap::Triangle;
using facemap::TruePoint;
using facemap::Vector;
using oracle::ParallelFace;
using oracle::Place;
using sign_inputs::Inputs;
using sign_inputs::Kind;

constexpr std::uint64_t kSeed = 0x5eed0401;

// Of each kind; of all together as many cases of each predicate as the environment says, or 216,000.
int rounds() {
  const char* queries = std::getenv("FACEMAP_QUERIES");
  return (queries != nullptr ? std::atoi(queries) : 216000) / static_cast<int>(Kind::kCount);
}

Place place_of(const TruePoint& p) { return oracle::place_of(facemap::SurfacePoint{p.K, p.d, p.face}); }

Place place_of(const GivenPoint& p) {
  return p.on_face == nullptr ? oracle::place_of(p.P) : oracle::place_on(*p.on_face, p.P);
}

bool is_blocked(const ParallelFace& G, const Place& P) {
  const ParallelFace::Meeting meeting = G.meet(P);
  return meeting.is_met && meeting.where < 0;
}

class ParallelSignsKinds : public testing::TestWithParam<int> {
 protected:
  // From one point of a face to another: so that what lies between is on the fence.
  Vector direction(const Triangle& from, const Triangle& to) {
    return Inputs::finite(inputs.near(to) - inputs.near(from));
  }

  Inputs inputs{static_cast<Kind>(GetParam()), kSeed + static_cast<std::uint64_t>(GetParam())};
  Counters counters;
};

TEST_P(ParallelSignsKinds, SidesAndHitsEqualTheReferee) {
  int hits = 0, behind = 0;
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), g = inputs.neighbour(f);
    const Vector d = direction(g, f), O = inputs.below(2) == 0 ? inputs.near(f) : inputs.near(g);
    const ParallelFace referee(f, d);
    const int s = referee.side();
    ASSERT_EQ(facemap::side_along(f, d, &counters), s) << "round " << i << ", seed " << kSeed;
    const ParallelFace::Meeting meeting = referee.meet(oracle::place_of(O));
    const bool expected = meeting.is_met && meeting.where > 0;
    const Covering got = facemap::covers_along(f, s, O, d, &counters);
    ASSERT_EQ(got.hit, expected) << "round " << i << ", seed " << kSeed;
    ASSERT_EQ(got.strictly_inside, expected && meeting.strictly_inside) << "round " << i << ", seed " << kSeed;
    const Covering central = facemap::covers(f, facemap::side(f, O), O, d);
    ASSERT_EQ(central.hit, expected) << "round " << i << ", seed " << kSeed;
    const int s_camera = inputs.below(3) - 1;
    ASSERT_EQ(facemap::is_facing_along(f, s_camera, d), s != 0 && s == s_camera) << "round " << i;
    hits += expected;
    behind += meeting.is_met && !expected;
  }
  EXPECT_GT(hits, rounds() / 200);
  EXPECT_GT(behind, rounds() / 200);
  EXPECT_GT(counters.by_exact, 0u);
  EXPECT_GT(counters.by_double, 0u);
}

TEST_P(ParallelSignsKinds, DepthsEqualTheReferee) {
  int asked = 0;
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), g = inputs.neighbour(f);
    const Vector d = direction(g, f), O = inputs.below(2) == 0 ? inputs.near(f) : inputs.near(g);
    const ParallelFace F(f, d), G(g, d);
    if (F.side() == 0 || G.side() == 0) continue;
    ASSERT_EQ(facemap::compare_depth(f, F.side(), g, G.side(), O, d, &counters),
              ParallelFace::compare(F, G, oracle::place_of(O)))
        << "round " << i << ", seed " << kSeed;
    ++asked;
  }
  EXPECT_GT(asked, rounds() / 10);
  EXPECT_GT(counters.by_exact, 0u);
}

TEST_P(ParallelSignsKinds, BlockersOfTruePointsEqualTheReferee) {
  int asked = 0, blocked = 0;
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), G = inputs.neighbour(f);
    const Vector K = inputs.near(G), ray = Inputs::finite(inputs.near(f) - K), d = direction(G, f);
    const int slope = ParallelFace(f, ray).side();
    if (slope == 0) continue;
    const TruePoint p{K, ray, f, slope};
    const ParallelFace referee(G, d);
    const bool expected = is_blocked(referee, place_of(p));
    ASSERT_EQ(facemap::blocks_along(G, referee.side(), d, p, &counters), expected)
        << "round " << i << ", seed " << kSeed;
    const bool is_seen = facemap::covers_along(f, slope, K, ray).hit;
    if (expected && is_seen) {
      ASSERT_TRUE(facemap::reaches_beyond(f, G, referee.side())) << "round " << i << ", seed " << kSeed;
    }
    ++asked;
    blocked += expected;
  }
  EXPECT_GT(asked, rounds() / 10);
  EXPECT_GT(blocked, asked / 1000);
  EXPECT_GT(counters.by_exact, 0u);
}

TEST_P(ParallelSignsKinds, BlockersOfGivenPointsEqualTheReferee) {
  int blocked = 0;
  for (int i = 0; i < rounds(); ++i) {
    const Triangle f = inputs.triangle(), G = inputs.neighbour(f);
    const Vector d = direction(G, f);
    GivenPoint p{inputs.near(f)};
    const int variant = inputs.below(3);
    if (variant == 1 && !oracle::has_zero_area(f[0], f[1], f[2])) p.on_face = &f;
    if (variant == 2) p.tolerance = std::fabs(inputs.coordinate());
    const ParallelFace referee(G, d);
    const bool expected = is_blocked(referee, place_of(p)) && ParallelFace::is_far(G, p.P, p.tolerance);
    ASSERT_EQ(facemap::blocks_along(G, referee.side(), d, p, &counters), expected)
        << "round " << i << ", seed " << kSeed;
    blocked += expected;
  }
  EXPECT_GT(blocked, rounds() / 1000);
  EXPECT_GT(counters.by_exact, 0u);
}

TEST_P(ParallelSignsKinds, TheRefereesDoublesSayWhatItsIntegersSay) {
  for (int i = 0; i < rounds() / 8; ++i) {
    const Triangle f = inputs.triangle(), g = inputs.neighbour(f);
    const ParallelFace referee(f, direction(g, f));
    const Place P = oracle::place_of(inputs.near(g));
    const ParallelFace::Meeting expected = referee.meet(P, false), got = referee.meet(P);
    ASSERT_EQ(got.is_met, expected.is_met) << "round " << i << ", seed " << kSeed;
    ASSERT_EQ(got.strictly_inside, expected.strictly_inside) << "round " << i << ", seed " << kSeed;
    ASSERT_EQ(got.where, expected.where) << "round " << i << ", seed " << kSeed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ParallelSignsKinds, testing::Range(0, static_cast<int>(Kind::kCount)));

}  // namespace
