#include <facemap/error.h>
#include <facemap/lens.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "math/elementary.h"
#include "support/lenses.h"
#include "support/random.h"

namespace {

using facemap::CubeLayout;
using facemap::DVector;
using facemap::Error;
using facemap::Lens;
using facemap::LensKind;
using facemap::MapPoint;
using facemap::elementary::kPi;

constexpr double kPixelTolerance = 1e-9;

double angle_between(const DVector& a, const DVector& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// On seams one direction has several places.
bool is_near_seam(const Lens& lens, const MapPoint& p) {
  if (lens.kind() != LensKind::Equirectangular && lens.kind() != LensKind::CubeMap) return false;
  const auto near = [](double x, int piece) { return std::fabs(x - std::nearbyint(x / piece) * piece) < 1e-6; };
  return near(p.x, lens.piece_width()) || near(p.y, lens.piece_height());
}

class EveryLens : public testing::TestWithParam<NamedLens> {
 protected:
  const Lens& lens_ = GetParam().lens;
};

TEST_P(EveryLens, PlacesComeBack) {
  const double step = lens_.width() > 400 ? 1.5 : 0.5;  // of pixels: borders and centres
  int seen = 0;
  for (double y = 0; y <= lens_.height(); y += step) {
    for (double x = 0; x <= lens_.width(); x += step) {
      const MapPoint p(x, y);
      const auto direction = lens_.direction(p);
      if (!direction) continue;
      ++seen;
      ASSERT_NEAR(glm::length(*direction), 1, 0x1p-48) << x << ' ' << y;
      ASSERT_LE(std::atan2(std::hypot(direction->x, direction->y), direction->z), lens_.largest_angle() + 1e-12);
      const auto again = lens_.map_point(*direction * 3.0);
      if (is_near_seam(lens_, p)) {
        ASSERT_TRUE(again) << x << ' ' << y;
        ASSERT_LE(angle_between(*lens_.direction(*again), *direction), 2 * lens_.angle_error());
        continue;
      }
      if (!again) {  // rounded past the field's end
        ASSERT_GE(std::atan2(std::hypot(direction->x, direction->y), direction->z), lens_.largest_angle() - 1e-12);
        continue;
      }
      ASSERT_LE(std::hypot(again->x - x, again->y - y), kPixelTolerance) << x << ' ' << y;
    }
  }
  EXPECT_GT(seen, 2000);
}

TEST_P(EveryLens, DirectionsComeBack) {
  Random random(73);
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    DVector d = random.direction();
    if (random.chance(0.5)) d = glm::normalize(d * DVector(0.1, 0.1, 1));
    const double angle = std::atan2(std::hypot(d.x, d.y), d.z);
    const auto place = lens_.map_point(d * random.between(1e-3, 1e3));
    if (!place) {  // beyond the field, or beyond 2^30 pixels
      EXPECT_GE(angle, std::min(lens_.largest_angle() - 1e-9, 1.4)) << i;
      continue;
    }
    EXPECT_LE(angle, lens_.largest_angle() + 1e-12);
    const auto again = lens_.direction(*place);
    if (!again) {
      EXPECT_GE(angle, lens_.largest_angle() - 1e-9) << i;
      continue;
    }
    // Outside of the picture bounds are not promised: there the field's end may be steep.
    const bool is_inside = place->x >= 0 && place->y >= 0 && place->x <= lens_.width() && place->y <= lens_.height();
    const double bound = 2 * lens_.angle_error() + 2 * Lens::kPlaceError * lens_.pixel_angle();
    EXPECT_LE(angle_between(*again, d), is_inside ? bound : 1e-6) << i << ' ' << place->x << ' ' << place->y;
    ++seen;
  }
  EXPECT_GT(seen, 1000);
}

TEST_P(EveryLens, TheSightIsSeenAndRightIsRightAndUpIsUp) {
  const auto place = lens_.map_point({0, 0, 2});
  ASSERT_TRUE(place);
  EXPECT_LE(angle_between(*lens_.direction(*place), {0, 0, 1}), lens_.angle_error());
  EXPECT_GT(lens_.map_point({0.01, 0, 1})->x, place->x);
  EXPECT_LT(lens_.map_point({-0.01, 0, 1})->x, place->x);
  EXPECT_LT(lens_.map_point({0, 0.01, 1})->y, place->y);
  EXPECT_GT(lens_.map_point({0, -0.01, 1})->y, place->y);
}

TEST_P(EveryLens, LengthsDoNotMatter) {
  const DVector d(0.3, -0.2, 1);
  const auto place = lens_.map_point(d);
  ASSERT_TRUE(place);
  for (const double scale : {0x1p-900, 0x1p-500, 0x1p600, 0x1p1000}) EXPECT_EQ(*lens_.map_point(d * scale), *place);
}

TEST_P(EveryLens, WhatIsNoDirectionHasNoPlace) {
  const double infinity = HUGE_VAL;
  for (const DVector& d :
       {DVector(0), DVector(NAN, 0, 1), DVector(0, NAN, 1), DVector(0, 0, infinity), DVector(0, -infinity, 1)}) {
    EXPECT_FALSE(lens_.map_point(d));
  }
  for (const MapPoint& p : {MapPoint(NAN, 1), MapPoint(1, NAN), MapPoint(infinity, 1), MapPoint(1, 1e10)}) {
    EXPECT_FALSE(lens_.direction(p));
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, EveryLens, testing::ValuesIn(all_lenses()),
                         [](const auto& test) { return test.param.name; });

// The bits of many directions of a lens: FNV-1a.
std::uint64_t hash_of(const Lens& lens) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](double value) {
    for (const auto bits = std::bit_cast<std::uint64_t>(value); const int shift : {0, 8, 16, 24, 32, 40, 48, 56}) {
      hash = (hash ^ ((bits >> shift) & 255)) * 0x100000001b3u;
    }
  };
  for (double y = 0; y <= lens.height(); y += lens.height() / 37.0) {
    for (double x = 0; x <= lens.width(); x += lens.width() / 41.0) {
      const auto direction = lens.direction({x, y});
      if (!direction) continue;
      add(direction->x), add(direction->y), add(direction->z);
      const auto place = lens.map_point(*direction);
      if (place) add(place->x), add(place->y);
    }
  }
  add(lens.largest_angle()), add(lens.pixel_angle()), add(lens.angle_error());
  return hash;
}

TEST(Lens, BitsAreTheSameEverywhere) {
  const std::map<std::string, std::uint64_t> expected = {
      {"Surface50", 0xb5f1d0ff57672a5eu},
      {"Surface220", 0xdf6e450a6d2681e8u},
      {"Surface360", 0x1ecb2f93158681c5u},
      {"Plane50", 0xd00e40649dff574au},
      {"Plane170", 0x8d2e7c6421decbe8u},
      {"Equirectangular", 0x71204d945ddf6907u},
      {"EquirectangularOdd", 0xd47d7b9ec0483b98u},
      {"CubeGrid", 0xe3979d7faaeafebdu},
      {"CubeRow", 0x7275771dd48bc8a0u},
      {"CubeColumn", 0x95d03cc13f048d16u},
      {"PinholePlain", 0x8a57aca4fcce67f2u},
      {"PinholeBarrel", 0x4b488b78203d45f8u},
      {"PinholeRational", 0xb7e632faa41f575cu},
      {"PinholePincushion", 0x60ca77d4eb95e420u},
      {"PinholeFolded", 0x3188c4b04c363a84u},
      {"PinholeFarOff", 0xbf7e0e9eea17c031u},
      {"FisheyePlain", 0x1282d69d35612545u},
      {"Fisheye220", 0x55a038dd94c334ecu},
      {"FisheyeFolded", 0xcd3bf97be08e51c3u},
      {"Fisheye360", 0x887eb9f30adb23bfu},
      {"PinholeDepthCamera", 0x40eb71f8e68b8712u},
  };
  for (const NamedLens& named : all_lenses()) {
    const std::uint64_t hash = hash_of(named.lens);
    EXPECT_TRUE(expected.contains(named.name) && expected.at(named.name) == hash)
        << "{\"" << named.name << "\", 0x" << std::hex << hash << "u},";
  }
}

TEST(Lens, AgreesWithTheProjectionsOfThePaper) {
  const facemap::Projection surface(facemap::ProjectionKind::Surface, 2, 64, 48);
  const Lens lens = Lens::surface(2, 64, 48);
  EXPECT_EQ(*lens.direction({7.5, 9.5}), surface.local_from_map({7.5, 9.5}));
  EXPECT_EQ(*lens.map_point({1, -2, -3}), surface.map_from_local({1, -2, -3}));
  EXPECT_FALSE(Lens::plane(1, 8, 8).map_point({1, 0, 0}));
  EXPECT_FALSE(lens.direction({200, 24}));
}

TEST(Lens, IsAValue) {
  Lens a = Lens::equirectangular(20, 10);
  const Lens b = std::move(a);
  EXPECT_EQ(a.width(), 20);
  a = Lens::cube_map(CubeLayout::Row6x1, 4);
  EXPECT_EQ(a.kind(), LensKind::CubeMap);
  EXPECT_EQ(b.kind(), LensKind::Equirectangular);
}

TEST(Lens, RefusesSizesAndFieldsOutOfRange) {
  for (const int size : {0, -1, 32769}) {
    EXPECT_THROW(Lens::surface(1, size, 8), Error);
    EXPECT_THROW(Lens::plane(1, 8, size), Error);
    EXPECT_THROW(Lens::equirectangular(size, 8), Error);
    EXPECT_THROW(Lens::equirectangular(8, size), Error);
    EXPECT_THROW(Lens::cube_map(CubeLayout::Grid3x2, size), Error);
    EXPECT_THROW(Lens::opencv_pinhole({1, 1, 0, 0}, {}, size, 8), Error);
    EXPECT_THROW(Lens::opencv_fisheye({1, 1, 0, 0}, {}, 8, size), Error);
  }
  EXPECT_THROW(Lens::cube_map(CubeLayout::Row6x1, 5462), Error);
  EXPECT_NO_THROW(Lens::cube_map(CubeLayout::Row6x1, 5461));
  EXPECT_THROW(Lens::cube_map(static_cast<CubeLayout>(7), 8), Error);
  EXPECT_THROW(Lens::surface(7, 8, 8), Error);
  EXPECT_THROW(Lens::plane(kPi, 8, 8), Error);
}

}  // namespace
