#include <facemap/error.h>
#include <facemap/turntable.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

namespace facemap {
namespace {

// World units: float32 rounds coordinates below 16 by half of 2^-20, and squares of those below 16^2 by a few 2^-17.
constexpr float kRounding = 0x1p-15f;

void expect_near(const Vector& a, const Vector& b) { EXPECT_LE(glm::length(a - b), kRounding) << a.x << ' ' << a.z; }

TEST(Turntable, GoesAroundOnce) {
  View first;
  first.position = {3, 2, 4};
  first.look_at = {1, 1, 1};
  first.field_angle = 0.5;
  const std::vector<View> views = turntable(first, 4);
  ASSERT_EQ(views.size(), 4u);
  EXPECT_EQ(views[0].position, first.position) << "the first is the given one to the last bit";
  expect_near(views[1].position, {4, 2, -1});
  expect_near(views[2].position, {-1, 2, -2});
  expect_near(views[3].position, {-2, 2, 3});
  for (const View& view : views) {
    EXPECT_EQ(view.look_at, first.look_at);
    EXPECT_EQ(view.up, first.up);
    EXPECT_EQ(view.field_angle, first.field_angle);
  }
}

TEST(Turntable, TurnsAboutUpOfAnyLength) {
  View first;
  first.position = {5, 7, 1};
  first.look_at = {0, 0, 2};
  first.up = {1, 2, -2};
  const std::vector<View> views = turntable(first, 7);
  View longer = first;
  longer.up = 1024.0f * first.up;
  const std::vector<View> same = turntable(longer, 7);
  const Vector offset = first.position - first.look_at;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Vector turned = views[i].position - first.look_at;
    EXPECT_NEAR(glm::dot(turned, first.up), glm::dot(offset, first.up), 3 * kRounding);
    EXPECT_NEAR(glm::dot(turned, turned), glm::dot(offset, offset), 32 * kRounding);
    EXPECT_EQ(same[i].position, views[i].position);
    EXPECT_GT(glm::length(views[i].position - views[(i + 1) % views.size()].position), 1.0f);
  }
}

TEST(Turntable, RefusesWhatHasNoAxis) {
  View view;
  EXPECT_EQ(turntable(view, 1).size(), 1u);
  EXPECT_THROW(turntable(view, 0), Error);
  view.up = Vector(0);
  EXPECT_THROW(turntable(view, 3), Error);
  view.up = Vector(std::numeric_limits<float>::infinity(), 0, 0);
  EXPECT_THROW(turntable(view, 3), Error);
}

}  // namespace
}  // namespace facemap
