#include "simd/face_kernels.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "simd/target.h"
#include "support/random.h"

namespace {

using namespace facemap::simd;

// ---- the definition ---------------------------------------------------------------------------------------

float dot(const FacePlanes& p, int plane, const float d[3]) {
  return p.x[plane] * d[0] + p.y[plane] * d[1] + p.z[plane] * d[2];
}

Verdict cone_verdict(const FacePlanes& p, const float d[3], float length) {
  const float bound = p.error * length + kUnderflow;
  bool is_inside = true;
  for (int i = 0; i < 3; ++i) {
    const float value = dot(p, i, d);
    if (value < -bound) return kNo;
    is_inside = is_inside && value > bound;
  }
  return is_inside ? kYes : kUndecided;
}

Verdict block_verdict(const FacePlanes& p, const ListPoint& point) {
  const float bound = p.error * point.length + p.offset_error + kUnderflow;
  const float beyond = dot(p, 3, point.D) - p.offset;
  if (beyond < -bound) return kNo;
  const Verdict cone = cone_verdict(p, point.D, point.length);
  return cone == kYes && !(beyond > bound) ? kUndecided : cone;
}

BlockWalk walk(const std::vector<FacePlanes>& planes, const std::vector<std::uint32_t>& ids, const ListPoint& point,
               std::uint32_t skip, std::vector<std::uint32_t>& undecided) {
  BlockWalk result;
  for (const std::uint32_t id : ids) {
    result.ended = planes[id].nearest > point.reach;
    if (result.ended) break;
    if (id == skip) continue;
    ++result.tested;
    const Verdict verdict = block_verdict(planes[id], point);
    result.blocked = verdict == kYes;
    if (result.blocked) break;
    if (verdict == kUndecided) undecided.push_back(id);
  }
  result.undecided = undecided.size();
  return result;
}

// ---- tables in which every verdict occurs, of numbers great and small, infinite and none at all -------------

float any_float(Random& random) {
  switch (random.below(12)) {
    case 0:
      return std::numeric_limits<float>::infinity();
    case 1:
      return std::numeric_limits<float>::quiet_NaN();
    case 2:
      return 0;
    case 3:
      return std::bit_cast<float>(static_cast<std::uint32_t>(random.below(1 << 23)));  // denormal
    default:
      return static_cast<float>(std::ldexp(random.between(-1.0, 1.0), random.between(-100, 60)));
  }
}

std::vector<FacePlanes> make_table(Random& random) {
  std::vector<FacePlanes> table;
  for (int face = 0; face < 200; ++face) {
    FacePlanes p;
    const bool is_wild = random.chance(0.2);
    const auto number = [&](double size) {
      return is_wild ? any_float(random) : static_cast<float>(random.between(-0.2, 1.0) * size);
    };
    for (int i = 0; i < 4; ++i) {
      p.x[i] = number(1);
      p.y[i] = number(1);
      p.z[i] = number(1);
    }
    p.offset = number(1.5);
    p.error = std::fabs(number(0x1p-5));
    p.offset_error = std::fabs(number(0x1p-5));
    p.nearest = is_wild ? any_float(random) : static_cast<float>(face * 0.01);
    table.push_back(p);
  }
  return table;
}

ListPoint make_point(Random& random) {
  ListPoint point;
  const bool is_wild = random.chance(0.1);
  for (float& x : point.D) x = is_wild ? any_float(random) : static_cast<float>(random.between(-0.3, 1.0));
  point.length = static_cast<float>(random.between(0.0, 2.0));
  point.reach = random.chance(0.5) ? 3.0f : static_cast<float>(random.between(0.0, 2.0));
  return point;
}

std::vector<std::uint32_t> make_list(Random& random) {
  std::vector<std::uint32_t> ids;
  for (int i = random.between(0, 30); i > 0; --i) ids.push_back(static_cast<std::uint32_t>(random.below(200)));
  return ids;
}

class EveryTarget : public testing::TestWithParam<Target> {
 protected:
  void SetUp() override { set_active_target(GetParam()); }
  void TearDown() override { set_active_target(best_); }

  Target best_ = active_target();
};

using FaceKernels = EveryTarget;

TEST_P(FaceKernels, ConesAreAsDefined) {
  Random random(21);
  int seen[3] = {0, 0, 0};
  for (int round = 0; round < 2000; ++round) {
    const std::vector<FacePlanes> table = make_table(random);
    const ListPoint d = make_point(random);
    const std::vector<std::uint32_t> ids = make_list(random);
    std::vector<Verdict> verdicts(ids.size());
    cone_verdicts(table.data(), ids.data(), ids.size(), d.D, d.length, verdicts.data());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      ASSERT_EQ(verdicts[i], cone_verdict(table[ids[i]], d.D, d.length));
      ++seen[verdicts[i]];
    }
  }
  for (const int count : seen) EXPECT_GT(count, 500);
}

TEST_P(FaceKernels, BlockersAreAsDefined) {
  Random random(23);
  int seen[3] = {0, 0, 0};
  for (int round = 0; round < 2000; ++round) {
    const std::vector<FacePlanes> table = make_table(random);
    const ListPoint point = make_point(random);
    const std::vector<std::uint32_t> ids = make_list(random);
    std::vector<Verdict> verdicts(ids.size());
    block_verdicts(table.data(), ids.data(), ids.size(), point, verdicts.data());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      ASSERT_EQ(verdicts[i], block_verdict(table[ids[i]], point));
      ++seen[verdicts[i]];
    }
  }
  for (const int count : seen) EXPECT_GT(count, 200);
}

TEST_P(FaceKernels, WalksAreAsDefined) {
  Random random(22);
  int blocked = 0, undecided_count = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::vector<FacePlanes> table = make_table(random);
    for (int i = 0; i < 8; ++i) {
      const ListPoint point = make_point(random);
      const std::vector<std::uint32_t> ids = make_list(random);
      const std::uint32_t skip = ids.empty() || random.chance(0.5) ? 0xffffffffu : ids[ids.size() / 2];
      std::vector<std::uint32_t> undecided(ids.size()), truly_undecided;
      const BlockWalk found = find_blocker(table.data(), ids.data(), ids.size(), point, skip, undecided.data());
      const BlockWalk truth = walk(table, ids, point, skip, truly_undecided);
      ASSERT_EQ(found.tested, truth.tested);
      ASSERT_EQ(found.blocked, truth.blocked);
      ASSERT_EQ(found.ended, truth.ended);
      undecided.resize(found.undecided);
      ASSERT_EQ(undecided, truly_undecided);
      blocked += found.blocked;
      undecided_count += found.undecided > 0;
    }
  }
  EXPECT_GT(blocked, 500);
  EXPECT_GT(undecided_count, 500);
}

TEST_P(FaceKernels, PointsTogetherAreAskedAsOneByOne) {
  Random random(23);
  for (int round = 0; round < 1000; ++round) {
    const std::vector<FacePlanes> table = make_table(random);
    const std::size_t count = static_cast<std::size_t>(random.between(0, static_cast<int>(kChunk)));
    std::vector<std::vector<std::uint32_t>> lists(count);
    std::vector<ListPoint> points(count);
    std::vector<const std::uint32_t*> ids(count);
    std::vector<std::uint32_t> counts(count);
    std::size_t decided = 0;
    std::vector<Verdict> truth(count), verdicts(count);
    for (std::size_t i = 0; i < count; ++i) {
      lists[i] = make_list(random);
      points[i] = make_point(random);
      ids[i] = lists[i].data();
      counts[i] = static_cast<std::uint32_t>(lists[i].size());
      std::vector<std::uint32_t> undecided;
      const BlockWalk one = walk(table, lists[i], points[i], 0xffffffffu, undecided);
      truth[i] = one.blocked ? kYes : undecided.empty() ? kNo : kUndecided;
      if (truth[i] != kUndecided) decided += one.tested - one.undecided;
    }
    ASSERT_EQ(find_blockers(table.data(), ids.data(), counts.data(), points.data(), count, verdicts.data()), decided);
    ASSERT_EQ(verdicts, truth);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FaceKernels, testing::ValuesIn(supported_targets()),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
