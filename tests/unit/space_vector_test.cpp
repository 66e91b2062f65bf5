#include <facemap/error.h>
#include <facemap/space_vector.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "support/random.h"

namespace {

using facemap::DVector;
using facemap::Error;
using facemap::SpaceVector;
using facemap::Vector;

// Axes are unit to a few roundings of 2^-53; so is a rotated unit vector, by component.
constexpr double kRounding = 0x1p-49;

void expect_near(const DVector& a, const DVector& b, double tolerance = kRounding) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

double determinant(const DVector& a, const DVector& b, const DVector& c) { return glm::dot(glm::cross(a, b), c); }

TEST(SpaceVector, LooksDownTheNegativeZAxisWithXToTheRight) {
  const SpaceVector frame = SpaceVector::looking_at(Vector(1, 2, 3), Vector(1, 2, -7));
  EXPECT_EQ(frame.position(), Vector(1, 2, 3));
  expect_near(frame.axis_x(), {1, 0, 0});
  expect_near(frame.axis_y(), {0, 1, 0});
  expect_near(frame.axis_z(), {0, 0, -1});
}

TEST(SpaceVector, LocalFrameOfARightHandedWorldIsLeftHanded) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const Vector position(random.in_cube() * 10.0), target(random.in_cube() * 10.0), up(random.in_cube());
    const SpaceVector frame = SpaceVector::looking_at(position, target, up);
    EXPECT_NEAR(determinant(frame.axis_x(), frame.axis_y(), frame.axis_z()), -1, kRounding);
    expect_near(frame.local_from_world(frame.axis_x()), {1, 0, 0});
    expect_near(frame.local_from_world(frame.axis_y()), {0, 1, 0});
    expect_near(frame.local_from_world(frame.axis_z()), {0, 0, 1});
  }
}

TEST(SpaceVector, SightIsTowardsTheTargetAndUpIsUp) {
  Random random(12);
  for (int i = 0; i < 2000; ++i) {
    const Vector position(random.in_cube() * 10.0), target(random.in_cube() * 10.0), up(random.in_cube());
    const SpaceVector frame = SpaceVector::looking_at(position, target, up);
    expect_near(frame.axis_z(), glm::normalize(DVector(target) - DVector(position)));
    EXPECT_GT(frame.local_from_world(DVector(up)).y, 0);
    EXPECT_NEAR(frame.local_from_world(DVector(up)).x, 0, kRounding);  // up is upright in the picture
  }
}

// Wang 2022, eq. (11) forwards, eq. (23) to (26) back.
TEST(SpaceVector, WorldFromLocalUndoesLocalFromWorld) {
  Random random(13);
  for (int i = 0; i < 2000; ++i) {
    const SpaceVector frame = SpaceVector::looking_along(Vector(random.in_cube()), random.direction());
    const DVector d = random.direction();
    expect_near(frame.world_from_local(frame.local_from_world(d)), d);
    expect_near(frame.local_from_world(frame.world_from_local(d)), d);
    EXPECT_NEAR(glm::length(frame.local_from_world(d)), 1, kRounding);
  }
}

TEST(SpaceVector, TransposeSolvesTheCramerSystem) {
  // Wang 2022, eq. (23) to (25) as printed, divided by D = -1.
  const SpaceVector frame = SpaceVector::looking_along(Vector(0), glm::normalize(DVector(0.3, -0.4, 0.7)));
  const DVector X = frame.axis_x(), Y = frame.axis_y(), Z = frame.axis_z(), L(0.2, -0.5, 0.6);
  const double D = determinant({X.x, Y.x, Z.x}, {X.y, Y.y, Z.y}, {X.z, Y.z, Z.z});
  const double D1 = determinant(L, {X.y, Y.y, Z.y}, {X.z, Y.z, Z.z});
  const double D2 = determinant({X.x, Y.x, Z.x}, L, {X.z, Y.z, Z.z});
  const double D3 = determinant({X.x, Y.x, Z.x}, {X.y, Y.y, Z.y}, L);
  EXPECT_NEAR(D, -1, kRounding);
  expect_near(frame.world_from_local(L), DVector(D1, D2, D3) / D);
}

TEST(SpaceVector, LookingAlongWorksForEveryAxis) {
  for (const DVector& sight : {DVector(1, 0, 0), DVector(-1, 0, 0), DVector(0, 1, 0), DVector(0, -1, 0),
                               DVector(0, 0, 1), DVector(0, 0, -1), DVector(0, 1e30, 1)}) {
    const SpaceVector frame = SpaceVector::looking_along(Vector(0), sight);
    expect_near(frame.axis_z(), glm::normalize(sight));
    EXPECT_NEAR(determinant(frame.axis_x(), frame.axis_y(), frame.axis_z()), -1, kRounding);
  }
}

TEST(SpaceVector, RefusesAFrameThatWouldMirror) {
  EXPECT_NO_THROW(SpaceVector(Vector(0), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}));
  EXPECT_THROW(SpaceVector(Vector(0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), Error);
  EXPECT_THROW(SpaceVector(Vector(0), {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}), Error);
}

TEST(SpaceVector, RefusesAxesThatAreNotOrthonormal) {
  EXPECT_THROW(SpaceVector(Vector(0), {1, 0, 0}, {0.1, 1, 0}, {0, 0, -1}), Error);
  EXPECT_THROW(SpaceVector(Vector(0), {2, 0, 0}, {0, 1, 0}, {0, 0, -1}), Error);
  EXPECT_THROW(SpaceVector(Vector(0), {0, 0, 0}, {0, 1, 0}, {0, 0, -1}), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SpaceVector(Vector(0), {nan, 0, 0}, {0, 1, 0}, {0, 0, -1}), Error);
}

TEST(SpaceVector, MakesNearlyOrthonormalAxesOrthonormalAndKeepsTheSight) {
  const double slack = 0.25 * SpaceVector::kOrthonormalTolerance;
  const SpaceVector frame(Vector(0), {1, slack, -slack}, {-slack, 1 + slack, 0}, {0, 0, -1});
  expect_near(frame.axis_z(), {0, 0, -1});
  EXPECT_NEAR(glm::dot(frame.axis_x(), frame.axis_y()), 0, kRounding);
  EXPECT_NEAR(glm::length(frame.axis_x()), 1, kRounding);
  EXPECT_NEAR(glm::length(frame.axis_y()), 1, kRounding);
}

TEST(SpaceVector, RefusesViewsWithoutAFrame) {
  EXPECT_THROW(SpaceVector::looking_at(Vector(1), Vector(1)), Error);
  EXPECT_THROW(SpaceVector::looking_at(Vector(0), Vector(0, 5, 0)), Error);
  EXPECT_THROW(SpaceVector::looking_at(Vector(0), Vector(0, 0, 1), Vector(0)), Error);
  EXPECT_THROW(SpaceVector::looking_along(Vector(0), DVector(0)), Error);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THROW(SpaceVector::looking_along(Vector(infinity, 0, 0), DVector(0, 0, 1)), Error);
}

TEST(SpaceVector, LengthsDoNotMatter) {
  // Squares of these leave float32, and of the first double precision would not hold them times 2^10 either.
  const SpaceVector far = SpaceVector::looking_at(Vector(0), Vector(0, 0, -3e38f), Vector(0, 3e38f, 0));
  const SpaceVector near = SpaceVector::looking_at(Vector(0), Vector(0, 0, -1e-44f), Vector(0, 1e-44f, 0));
  expect_near(far.axis_x(), {1, 0, 0});
  expect_near(near.axis_x(), {1, 0, 0});
}

}  // namespace
