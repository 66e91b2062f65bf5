#include <facemap/lens.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "support/random.h"

namespace {

using facemap::CubeLayout;
using facemap::DVector;
using facemap::Lens;
using facemap::MapPoint;
using facemap::elementary::kPi;

void expect_near(const MapPoint& a, const MapPoint& b) {
  EXPECT_NEAR(a.x, b.x, 1e-11);
  EXPECT_NEAR(a.y, b.y, 1e-11);
}

bool is_inside(const Lens& lens, const MapPoint& p) {
  return p.x >= 0 && p.x < lens.width() && p.y >= 0 && p.y < lens.height();
}

TEST(Equirectangular, LongitudeGoesAcrossAndLatitudeDown) {
  const Lens lens = Lens::equirectangular(400, 200);
  expect_near(*lens.map_point({0, 0, 1}), {200, 100});
  expect_near(*lens.map_point({1, 0, 0}), {300, 100});
  expect_near(*lens.map_point({-1, 0, 0}), {100, 100});
  expect_near(*lens.map_point({1, 1, 0}), {300, 50});
  expect_near(*lens.map_point({0, -1, 1}), {200, 150});
  EXPECT_LT(glm::distance(*lens.direction({250, 100}), DVector(std::sqrt(0.5), 0, std::sqrt(0.5))), 1e-14);
}

TEST(Equirectangular, TheSeamIsBehindAtTheLeftBorder) {
  const Lens lens = Lens::equirectangular(400, 200);
  EXPECT_EQ(lens.map_point({0.0, 0, -1})->x, 0);
  EXPECT_EQ(lens.map_point({-0.0, 0, -1})->x, 0);
  EXPECT_NEAR(lens.map_point({1e-6, 0, -1})->x, 400, 1e-4);
  EXPECT_NEAR(lens.map_point({-1e-6, 0, -1})->x, 0, 1e-4);
  EXPECT_TRUE(is_inside(lens, *lens.map_point({1e-300, 0, -1})));
  EXPECT_LT(glm::distance(*lens.direction({0, 100}), *lens.direction({400, 100})), 1e-15);
}

TEST(Equirectangular, PolesAreTheUpperAndLowerBorder) {
  const Lens lens = Lens::equirectangular(400, 200);
  EXPECT_NEAR(lens.map_point({0, 1, 0})->y, 0, 1e-12);
  EXPECT_NEAR(lens.map_point({0, -1, 0})->y, 200, 1e-12);
  for (double x = 0; x <= 400; x += 12.5) {
    EXPECT_LT(glm::distance(*lens.direction({x, 0}), DVector(0, 1, 0)), 1e-15);
    EXPECT_LT(glm::distance(*lens.direction({x, 200}), DVector(0, -1, 0)), 1e-15);
  }
}

TEST(Panorama, EveryDirectionHasAPlaceStrictlyInside) {
  Random random(76);
  const Lens lenses[] = {Lens::equirectangular(401, 77), Lens::cube_map(CubeLayout::Grid3x2, 37),
                         Lens::cube_map(CubeLayout::Row6x1, 5461), Lens::cube_map(CubeLayout::Column1x6, 1)};
  for (const Lens& lens : lenses) {
    for (int i = 0; i < 20000; ++i) {
      DVector d = random.direction();
      if (i % 3 == 0) d = DVector(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
      if (i % 3 == 1) d[i % 2] *= 1e-16;
      if (d == DVector(0)) continue;
      const auto place = lens.map_point(d);
      ASSERT_TRUE(place);
      ASSERT_TRUE(is_inside(lens, *place)) << d.x << ' ' << d.y << ' ' << d.z;
    }
  }
}

TEST(Panorama, HasNoDirectionOutsideOfThePicture) {
  for (const Lens& lens : {Lens::equirectangular(40, 20), Lens::cube_map(CubeLayout::Grid3x2, 8)}) {
    EXPECT_TRUE(lens.direction({0, 0}));
    EXPECT_TRUE(lens.direction({lens.width(), lens.height()}));
    EXPECT_FALSE(lens.direction({-1e-9, 3}));
    EXPECT_FALSE(lens.direction({3, lens.height() + 1e-9}));
  }
}

// OpenGL 4.6, section 8.13: the face and its s and t of (rx, ry, rz), written from the specification's table.
struct Texel {
  int face;
  double s, t;
};

Texel opengl_texel(double rx, double ry, double rz) {
  const double ax = std::fabs(rx), ay = std::fabs(ry), az = std::fabs(rz);
  const auto at = [](int face, double sc, double tc, double ma) {
    return Texel{face, 0.5 * (sc / ma + 1), 0.5 * (tc / ma + 1)};
  };
  if (ax >= ay && ax >= az) return rx > 0 ? at(0, -rz, -ry, ax) : at(1, rz, -ry, ax);
  if (ay >= az) return ry > 0 ? at(2, rx, rz, ay) : at(3, rx, -rz, ay);
  return rz > 0 ? at(4, rx, -ry, az) : at(5, -rx, -ry, az);
}

TEST(CubeMap, FacesLieAndTurnAsOpenGLHasIt) {
  Random random(77);
  constexpr int kSize = 64;
  const struct {
    CubeLayout layout;
    int columns;
  } layouts[] = {{CubeLayout::Grid3x2, 3}, {CubeLayout::Row6x1, 6}, {CubeLayout::Column1x6, 1}};
  for (const auto& [layout, columns] : layouts) {
    const Lens lens = Lens::cube_map(layout, kSize);
    EXPECT_EQ(lens.width(), columns * kSize);
    EXPECT_EQ(lens.height(), 6 / columns * kSize);
    EXPECT_EQ(lens.piece_width(), kSize);
    for (int i = 0; i < 5000; ++i) {
      const DVector d = random.direction();
      const Texel texel = opengl_texel(d.x, d.y, d.z);
      const MapPoint expected((texel.face % columns + texel.s) * kSize, (texel.face / columns + texel.t) * kSize);
      const MapPoint place = *lens.map_point(d);
      EXPECT_NEAR(place.x, expected.x, 1e-10);
      EXPECT_NEAR(place.y, expected.y, 1e-10);
    }
  }
}

TEST(CubeMap, TheFrontFaceIsAViewOfNinetyDegrees) {
  const Lens cube = Lens::cube_map(CubeLayout::Grid3x2, 50), plane = Lens::plane(kPi / 2, 50, 50);
  for (double x = 0.5; x < 50; x += 1) {
    EXPECT_LT(glm::distance(*cube.direction({50 + x, 50 + 12.5}), *plane.direction({x, 12.5})), 1e-15);
  }
}

TEST(CubeMap, EdgesBelongToTheFirstAxisAndCornersHaveAPlace) {
  const Lens lens = Lens::cube_map(CubeLayout::Row6x1, 10);
  EXPECT_LT(lens.map_point({1, 1, 0})->x, 10);
  EXPECT_LT(lens.map_point({1, 1, 1})->x, 10);
  EXPECT_EQ(std::floor(lens.map_point({-1, 1, -1})->x / 10), 1);
  EXPECT_EQ(std::floor(lens.map_point({0, 1, 1})->x / 10), 2);
  EXPECT_EQ(std::floor(lens.map_point({0, -1, -1})->x / 10), 3);
}

}  // namespace
