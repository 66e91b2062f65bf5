#include "map/edge_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "support/random.h"

namespace {

using facemap::append_edge_curve;
using facemap::DVector;
using facemap::MapPoint;
using facemap::Projection;
using facemap::ProjectionKind;
using facemap::elementary::kPi;

std::vector<MapPoint> curve_of(const DVector& a, const DVector& b, const Projection& projection) {
  std::vector<MapPoint> curve;
  append_edge_curve({a, projection.map_from_local(a)}, {b, projection.map_from_local(b)}, projection, curve);
  return curve;
}

double distance(const MapPoint& a, const MapPoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

bool is_on_raster(const MapPoint& p, const Projection& projection) {
  return p.x >= 0 && p.x <= projection.width() && p.y >= 0 && p.y <= projection.height();
}

TEST(EdgeCurve, ShortEdgeIsItsFirstEnd) {
  const Projection map(ProjectionKind::Surface, kPi / 2, 64, 64);
  const DVector a(0.1, 0.2, 1), b(0.1, 0.205, 1);
  const std::vector<MapPoint> curve = curve_of(a, b, map);
  ASSERT_EQ(curve.size(), 1u);
  EXPECT_EQ(curve[0], map.map_from_local(a));
}

TEST(EdgeCurve, NeighboursAreAtMostAPixelApart) {
  const Projection map(ProjectionKind::Surface, 2 * kPi, 256, 256);
  Random random(31);
  for (int i = 0; i < 2000; ++i) {
    const DVector a = random.in_cube(), b = random.in_cube();
    std::vector<MapPoint> curve = curve_of(a, b, map);
    EXPECT_EQ(curve.front(), map.map_from_local(a));
    curve.push_back(map.map_from_local(b));
    for (std::size_t k = 1; k < curve.size(); ++k) {
      EXPECT_LE(distance(curve[k - 1], curve[k]), 1.0) << "edge " << i << ", point " << k;
    }
  }
}

TEST(EdgeCurve, PointsLieOnTheGreatCircle) {
  const Projection map(ProjectionKind::Surface, 2 * kPi, 256, 256);
  Random random(32);
  for (int i = 0; i < 500; ++i) {
    const DVector a = random.in_cube(), b = random.in_cube();
    const DVector n = glm::normalize(glm::cross(a, b));
    for (const MapPoint& p : curve_of(a, b, map)) {
      EXPECT_NEAR(glm::dot(map.local_from_map(p), n), 0, 1e-12 / glm::length(glm::cross(a, b)));
    }
  }
}

TEST(EdgeCurve, AnEdgeIsBentOnASurfaceAndStraightOnAPlane) {
  const DVector a(-1, 0.5, 1), b(1, 0.5, 1);
  double lowest_surface = 64, lowest_plane = 64;
  const Projection surface(ProjectionKind::Surface, kPi / 2, 64, 64), plane(ProjectionKind::Plane, kPi / 2, 64, 64);
  for (const MapPoint& p : curve_of(a, b, surface)) lowest_surface = std::min(lowest_surface, p.y);
  for (const MapPoint& p : curve_of(a, b, plane)) lowest_plane = std::min(lowest_plane, p.y);
  EXPECT_LT(lowest_surface, surface.map_from_local(a).y - 1);
  EXPECT_NEAR(lowest_plane, plane.map_from_local(a).y, 1e-9);
}

TEST(EdgeCurve, AnEdgeNearTheAntipodeSwingsRoundTheRim) {
  const Projection map(ProjectionKind::Surface, 2 * kPi, 128, 128);
  const std::vector<MapPoint> curve = curve_of({-1, 1e-6, -1}, {1, 1e-6, -1}, map);
  EXPECT_GT(curve.size(), 3.14 * 64);  // half the rim, in pixels
  bool is_at_top = false;
  for (const MapPoint& p : curve) is_at_top = is_at_top || p.y < 1;
  EXPECT_TRUE(is_at_top);
}

TEST(EdgeCurve, AnEdgeAcrossTheAntipodeEnds) {
  const Projection map(ProjectionKind::Surface, 2 * kPi, 1024, 1024);
  const std::vector<MapPoint> curve = curve_of({-1, 0, -1}, {1, 0, -1.5}, map);
  EXPECT_LT(curve.size(), 4096u);
  EXPECT_GT(curve.size(), 100u);
}

TEST(EdgeCurve, AnEdgeThroughTheOriginEnds) {
  // Its middle has no map point; a face with such an edge is seen edge-on and is in no map.
  const Projection map(ProjectionKind::Surface, 2 * kPi, 128, 128);
  EXPECT_EQ(curve_of({-1, 2, 3}, {1, -2, -3}, map).size(), 1u);
}

TEST(EdgeCurve, CostsLittleFarOutsideTheRaster) {
  // Half a circle behind a camera of 0.01 degrees is 58 million pixels long.
  const Projection map(ProjectionKind::Surface, kPi / 18000, 1024, 1024);
  EXPECT_LT(curve_of({-1, 0.1, -1}, {1, 0.1, -1}, map).size(), 1000u);
  const Projection plane(ProjectionKind::Plane, 0.1, 1024, 1024);
  EXPECT_LT(curve_of({-1, 0.1, 1e-12}, {1, 0.1, 1}, plane).size(), 3000u);
}

TEST(EdgeCurve, IsAsFineOnTheRasterWhereItComesFromOutside) {
  const Projection map(ProjectionKind::Surface, kPi / 6, 64, 64);
  std::vector<MapPoint> curve = curve_of({-3, 0.05, -0.2}, {3, 0.05, 1}, map);
  int on_raster = 0;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    if (!is_on_raster(curve[k - 1], map) && !is_on_raster(curve[k], map)) continue;
    EXPECT_LE(distance(curve[k - 1], curve[k]), 1.0);
    ++on_raster;
  }
  EXPECT_GT(on_raster, 60);
}

}  // namespace
