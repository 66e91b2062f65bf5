#include "map/plane_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random.h"

namespace {

using namespace facemap;

constexpr int kSize = 24;  // rows and columns

// A triangle of map points, of any shape, and its side: 1 if it runs clockwise on the map, whose y points down.
struct Image {
  MapPoint corners[3];
  int side;
};

Image make_image(Random& random) {
  Image image;
  do {
    const double size = std::pow(2.0, random.between(-4.0, 6.0));
    const MapPoint middle(random.between(0.0, double(kSize)), random.between(0.0, double(kSize)));
    for (MapPoint& p : image.corners) p = middle + MapPoint(random.between(-size, size), random.between(-size, size));
    if (random.chance(0.2)) image.corners[1].y = image.corners[0].y;  // along a row
    if (random.chance(0.2)) image.corners[2].x = image.corners[0].x;
    if (random.chance(0.2)) {  // a sliver
      const double share = random.unit();
      image.corners[2] = image.corners[0] + share * (image.corners[1] - image.corners[0]) +
                         MapPoint(random.between(-1e-6, 1e-6), random.between(-1e-6, 1e-6));
    }
    const MapPoint a = image.corners[1] - image.corners[0], b = image.corners[2] - image.corners[0];
    image.side = a.x * b.y - a.y * b.x > 0 ? 1 : a.x * b.y - a.y * b.x < 0 ? -1 : 0;
  } while (image.side == 0);
  return image;
}

double edge_value(const Image& image, int i, const MapPoint& p) {
  const MapPoint a = image.corners[i], along = image.corners[(i + 1) % 3] - a;
  return image.side * (along.x * (p.y - a.y) - along.y * (p.x - a.x));
}

bool has(const PlaneFace::Columns& columns, int x) { return x >= columns.first && x <= columns.last; }

TEST(PlaneFace, TouchesEveryTexelThatHoldsAPointOfIt) {
  Random random(41);
  int touched = 0, held = 0;
  for (int round = 0; round < 3000; ++round) {
    const Image image = make_image(random);
    const double margin = random.chance(0.5) ? 1e-9 : 0.01;
    const PlaneFace face(image.corners, image.side, margin, MapPoint(0, 0));
    bool holds[kSize][kSize] = {};
    for (int i = 0; i < 2000; ++i) {
      double u = random.unit(), v = i % 3 == 0 ? 0 : random.unit();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      // A point whose place is off by the margin belongs to whatever texel it comes to lie in.
      const MapPoint p = image.corners[0] + u * (image.corners[1] - image.corners[0]) +
                         v * (image.corners[2] - image.corners[0]) +
                         0.999 * margin * MapPoint(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
      if (!(p.x >= 0 && p.x < kSize && p.y >= 0 && p.y < kSize)) continue;
      const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
      holds[y][x] = true;
      ASSERT_TRUE(has(face.touched(y, kSize - 1), x)) << "round " << round << ": " << p.x << ' ' << p.y;
    }
    double area = 0;
    for (int i = 0; i < 3; ++i) {
      area += image.corners[i].x * image.corners[(i + 1) % 3].y - image.corners[i].y * image.corners[(i + 1) % 3].x;
    }
    if (std::fabs(area) > 400) continue;  // too large for so few points
    const auto [x0, x1] = std::minmax({image.corners[0].x, image.corners[1].x, image.corners[2].x});
    const auto [y0, y1] = std::minmax({image.corners[0].y, image.corners[1].y, image.corners[2].y});
    for (int y = std::max(0, int(y0)); y <= std::min(kSize - 1, int(y1)); ++y) {
      const PlaneFace::Columns columns = face.touched(y, kSize - 1);
      for (int x = std::max(0, int(x0)); x <= std::min(kSize - 1, int(x1)); ++x) {
        touched += has(columns, x);
        held += holds[y][x];
      }
    }
  }
  EXPECT_LT(touched, 1.2 * held) << "and few others";
}

TEST(PlaneFace, CoversTexelsOfWhichEveryPointIsInside) {
  Random random(42);
  int covered_count = 0, inside_count = 0;
  for (int round = 0; round < 3000; ++round) {
    const Image image = make_image(random);
    const double margin = 1e-9;
    const PlaneFace face(image.corners, image.side, margin, MapPoint(0, 0));
    for (int y = 0; y < kSize; ++y) {
      const PlaneFace::Columns covered = face.covered(y, kSize - 1);
      for (int x = 0; x < kSize; ++x) {
        double least = HUGE_VAL;
        for (int i = 0; i < 3; ++i) {
          for (int corner = 0; corner < 4; ++corner) {
            const MapPoint p(x + corner % 2 + (corner % 2 ? margin : -margin),
                             y + corner / 2 + (corner / 2 ? margin : -margin));
            least = std::min(least, edge_value(image, i, p));
          }
        }
        if (has(covered, x)) {
          ASSERT_GE(least, 0) << "round " << round << ": " << x << ' ' << y;
        }
        covered_count += has(covered, x);
        inside_count += least > 1e-3;
      }
    }
  }
  EXPECT_GT(covered_count, 10000);
  EXPECT_GE(covered_count, inside_count);
}

TEST(PlaneFace, RowsAndColumnsCountFromTheOrigin) {
  Random random(43);
  for (int round = 0; round < 300; ++round) {
    const Image image = make_image(random);
    const PlaneFace face(image.corners, image.side, 1e-9, MapPoint(0, 0));
    const PlaneFace moved(image.corners, image.side, 1e-9, MapPoint(5, 7));
    for (int y = 7; y < kSize; ++y) {
      const PlaneFace::Columns a = face.touched(y, kSize - 1), b = moved.touched(y - 7, kSize - 6);
      for (int x = 5; x < kSize; ++x) EXPECT_EQ(has(a, x), has(b, x - 5)) << round;
    }
  }
}

TEST(PlaneFace, DepthsAreNoLessThanTheFacesInATexelAndLittleMore) {
  Random random(44);
  const SpaceVector frame = SpaceVector::looking_along(Vector(0), DVector(0, 0, -1));
  const Projection projection(ProjectionKind::Plane, 1.5, kSize, kSize);
  for (int round = 0; round < 500; ++round) {
    const double tilt = random.between(-0.5, 0.5), lean = random.between(-0.5, 0.5);
    const auto depth_at = [&](double x, double y) { return 3 + tilt * x + lean * y; };
    Triangle face;
    const double places[3][2] = {{-20, -20}, {20, -20}, {0, 30}};
    for (int i = 0; i < 3; ++i) {
      // On the plane z = -(3 + tilt x + lean y), kept in front.
      const double x = places[i][0] * 0.2, y = places[i][1] * 0.2;
      face[i] = Vector(float(x), float(y), float(-depth_at(x, y)));
    }
    const int s = side(face, Vector(0));
    if (s == 0) continue;
    const PlaneDepth depth(face, s, frame, projection, 1e-9);
    const DVector a(face[0]), u = DVector(face[1]) - a, v = DVector(face[2]) - a;
    const DVector n(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    for (int i = 0; i < 100; ++i) {
      const int x = random.below(kSize), y = random.below(kSize);
      const DVector d =
          frame.world_from_local(projection.local_from_map(MapPoint(x + random.unit(), y + random.unit())));
      const double t = (n.x * a.x + n.y * a.y + n.z * a.z) / (n.x * d.x + n.y * d.y + n.z * d.z);
      const double p = n.x * (d.x * t - a.x) + n.y * (d.y * t - a.y) + n.z * (d.z * t - a.z);
      ASSERT_NEAR(p, 0, 1e-6);
      const auto inside = covers(face, s, Vector(0), Vector(d));
      if (!inside.hit) continue;
      ASSERT_LE(t, depth.farthest(x, y) * (1 + 1e-9)) << round;
      ASSERT_GE(t * 1.7, depth.farthest(x, y)) << round;
    }
  }
}

}  // namespace
