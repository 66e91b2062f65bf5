// The bounds that make a map's lists supersets, each by itself: caps of texels, bulge of edges, distances of faces,
// cones, the cut of a list. A bound that is too small by a little rarely costs an answer; here it fails at once.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "map/cone.h"
#include "map/cover.h"
#include "map/face_planes.h"
#include "map/texels.h"
#include "support/scenes.h"

namespace {

using namespace facemap;

constexpr double kRounding = 1e-12;  // relative and in radians: of the sampling in these tests, not of the bounds

double angle_between(const DVector& a, const DVector& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Vector rounded(const DVector& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

// A unit vector at `angle` from the unit vector `axis`.
DVector tilted(const DVector& axis, double angle, Random& random) {
  const DVector aside = glm::normalize(glm::cross(axis, random.direction()));
  return std::cos(angle) * axis + std::sin(angle) * aside;
}

Projection any_projection(Random& random) {
  const int width = random.between(1, 100), height = random.between(1, 100);
  if (random.chance(0.3)) return {ProjectionKind::Plane, random.between(0.01, 3.1), width, height};
  const double field = random.chance(0.3) ? std::pow(2.0, random.between(-24.0, -1.0)) : random.between(0.5, 2 * M_PI);
  return {ProjectionKind::Surface, field, width, height};
}

TEST(Bounds, TheCapOfABlockHoldsEveryDirectionThatProjectsIntoIt) {
  Random random(0x5eed0060);
  double fullest = 0;
  for (int round = 0; round < 3000; ++round) {
    const Projection projection = any_projection(random);
    const int size = 1 << random.below(4);
    const double x = random.below(projection.width()), y = random.below(projection.height());
    const MapPoint centre(x + size * 0.5, y + size * 0.5);
    if (!projection.has_direction(centre)) continue;
    const DVector c = projection.local_from_map(centre);
    const double radius = block_cap_radius(projection, size);
    for (int i = 0; i < 20; ++i) {
      const bool is_corner = i < 4;
      const double u = is_corner ? i % 2 : random.unit(), v = is_corner ? i / 2 : random.unit();
      const MapPoint p(x + size * u, y + size * v);
      if (!projection.has_direction(p)) continue;
      const double angle = angle_between(c, projection.local_from_map(p));
      ASSERT_LE(angle, radius + 1e-15) << size << ' ' << projection.field_angle();
      fullest = std::max(fullest, angle / radius);
    }
  }
  EXPECT_GT(fullest, 0.99);  // and not much too large: corners of small texels reach it
}

TEST(Bounds, TheCapOfATexelHoldsDirectionsThatAreOffByTheirError) {
  // A direction that belongs just outside a corner may be handed to the map just inside it. The smaller the field,
  // the more of a texel that error is.
  for (const double field : {1e-6, 1e-3, 0.87, 3.0}) {
    for (const ProjectionKind kind : {ProjectionKind::Surface, ProjectionKind::Plane}) {
      const Projection projection(kind, field, 64, 64);
      const double outside = 0.5 * 0.999 * facemap::kDirectionError / projection.texel_angle();  // texels in x and y
      for (int texel = 20; texel < 44; ++texel) {
        const DVector c = projection.local_from_map(MapPoint(texel + 0.5, texel + 0.5));
        const DVector corner = projection.local_from_map(MapPoint(texel + 1 + outside, texel + 1 + outside));
        EXPECT_LE(angle_between(corner, c), block_cap_radius(projection, 1)) << field << ' ' << texel;
      }
    }
  }
}

TEST(Bounds, ADirectionStaysInItsTexelsCapOverWholeFields) {
  Random random(0x5eed0061);
  for (int round = 0; round < 400; ++round) {
    const Projection projection = any_projection(random);
    const double radius = block_cap_radius(projection, 1);
    const bool is_plane = projection.kind() == ProjectionKind::Plane;
    for (int i = 0; i < 50; ++i) {
      const double reach = is_plane ? 1.3 : std::min(M_PI, projection.field_angle() / 2);
      const DVector d = tilted({0, 0, 1}, reach * random.unit(), random);
      const MapPoint p = projection.map_from_local(d);
      if (!(p.x >= 0 && p.y >= 0 && p.x < projection.width() && p.y < projection.height())) continue;
      const MapPoint centre(std::floor(p.x) + 0.5, std::floor(p.y) + 0.5);
      ASSERT_LE(angle_between(projection.local_from_map(centre), d), radius) << projection.field_angle();
    }
  }
}

// How far the image of the arc from a to b is from the chord of its ends, in radians of the map's scale.
double measured_bulge(const Projection& projection, const DVector& a, const DVector& b) {
  const MapPoint p = projection.map_from_local(a), q = projection.map_from_local(b);
  const MapPoint along = glm::normalize(q - p);
  double farthest = 0;
  for (int i = 1; i < 32; ++i) {
    const double t = i / 32.0;
    const MapPoint m = projection.map_from_local((1 - t) * a + t * b) - p;
    farthest = std::max(farthest, std::fabs(m.x * along.y - m.y * along.x));
  }
  return farthest * projection.texel_angle();
}

TEST(Bounds, EdgesBulgeNoMoreThanTheirBound) {
  Random random(0x5eed0062);
  const Projection projection(ProjectionKind::Surface, 2 * M_PI, 1000, 1000);
  for (const double beta : {0.05, 0.5, 1.2, M_PI / 2, 1.87, 2.1, 2.6}) {
    double fullest = 0;
    for (int i = 0; i < 20000; ++i) {
      const double angle = std::pow(2.0, random.between(-6.0, -1.0));
      if (angle > 0.9 * beta) continue;
      // Ends as far from the axis as is allowed, or anywhere within it; the arc between must stay within it too.
      const DVector a = tilted({0, 0, 1}, i % 2 ? beta : beta * random.unit(), random);
      const DVector b = tilted(a, angle, random);
      double farthest_beta = 0;
      for (int k = 0; k <= 16; ++k) {
        farthest_beta = std::max(farthest_beta, angle_between({0, 0, 1}, (1 - k / 16.0) * a + k / 16.0 * b));
      }
      if (farthest_beta > beta + 1e-9) continue;
      const double measured = measured_bulge(projection, a, b), bound = bulge(angle, beta);
      ASSERT_LE(measured, bound * (1 + 1e-6) + kRounding) << beta << ' ' << angle;
      fullest = std::max(fullest, measured / bound);
    }
    // An edge square to the radius at beta nearly reaches it.
    EXPECT_GT(fullest, 0.7) << beta;
  }
}

TEST(Bounds, NoPointOfAFaceIsNearerThanItsDistanceBound) {
  Random random(0x5eed0063);
  for (int i = 0; i < 20000; ++i) {
    DVector v[3];
    const double height_above = random.between(0.0, 3.0);
    for (DVector& corner : v) corner = 2.0 * random.in_cube() + DVector(0, 0, height_above);
    if (i % 2) {  // equilateral about the axis: its middle is exactly as near as the bound says
      const double spread = random.between(0.1, 1.4), height = random.between(0.2, 2.0),
                   turn = random.between(0.0, 6.0);
      for (int k = 0; k < 3; ++k) {
        const double t = turn + k * 2 * M_PI / 3;
        v[k] = {spread * std::cos(t), spread * std::sin(t), height};
      }
    }
    const double nearest_corner = std::min({glm::length(v[0]), glm::length(v[1]), glm::length(v[2])});
    const double longest_edge =
        std::max({glm::length(v[1] - v[0]), glm::length(v[2] - v[1]), glm::length(v[0] - v[2])});
    const double bound = distance_bound(nearest_corner, longest_edge);
    for (int k = 0; k < 12; ++k) {
      double p = random.unit(), q = random.unit();
      if (p + q > 1) p = 1 - p, q = 1 - q;
      if (k == 0) p = q = 1.0 / 3;
      const double distance = glm::length(v[0] + p * (v[1] - v[0]) + q * (v[2] - v[0]));
      ASSERT_LE(bound, distance * (1 + kRounding));
      const bool is_tightest = i % 2 == 1 && k == 0;
      ASSERT_TRUE(!is_tightest || bound >= distance * (1 - 1e-9));
    }
  }
}

TEST(Bounds, TheTableOfPlanesNeverOverstatesADistance) {
  Random random(0x5eed0064);
  for (int round = 0; round < 100; ++round) {
    const test_scenes::TestScene test = test_scenes::make_any_scene(random, 60);
    const Scene scene(test.mesh);
    const Vector origin = test_scenes::make_origin(test, random);
    const FacePlanesTable table(scene, origin);
    for (const std::uint32_t face : scene.kept_faces()) {
      if (table.side(face) == 0) continue;
      const DVector a(scene.mesh().vertex(face, 0)), b(scene.mesh().vertex(face, 1)), c(scene.mesh().vertex(face, 2));
      for (int i = 0; i < 10; ++i) {
        double p = random.unit(), q = random.unit();
        if (p + q > 1) p = 1 - p, q = 1 - q;
        const double distance = glm::length(a + p * (b - a) + q * (c - a) - DVector(origin));
        // The table rounds down by 2^-23 relative; the sampled point is off by 2^-50 of its coordinates.
        const double sampling = 0x1p-48 * (glm::length(DVector(origin)) + glm::length(a));
        ASSERT_LE(table.nearest(face), (distance + sampling) * table.scale()) << test.name;
      }
    }
  }
}

struct Facing {
  Triangle face;
  int side;
  Cone cone;
  DVector corner[3];  // local
};

// A random face about the origin, in any position and of any size, slivers too.
std::vector<Facing> random_faces(int count, const SpaceVector& frame, Random& random) {
  std::vector<Facing> faces;
  while (static_cast<int>(faces.size()) < count) {
    const double size = std::pow(2.0, random.between(-8.0, 2.0));
    const DVector at = random.direction();
    Triangle face{rounded(at + size * random.in_cube()), rounded(at + size * random.in_cube()),
                  rounded(at + size * random.in_cube())};
    if (random.chance(0.3)) {
      const double width = std::pow(2.0, random.between(-20.0, -8.0));
      face[2] = rounded(DVector(face[0]) + 0.4 * (DVector(face[1]) - DVector(face[0])) + width * random.in_cube());
    }
    const int s = side(face, frame.position());
    if (s == 0) continue;
    Facing f{face, s, Cone(face, s, frame), {}};
    for (int i = 0; i < 3; ++i) f.corner[i] = frame.local_from_world(DVector(face[i]) - DVector(frame.position()));
    faces.push_back(f);
  }
  return faces;
}

// The least of the sines of the angles by which d is inside the three planes of the cone.
double depth_inside(const Facing& f, const DVector& d) {
  double least = HUGE_VAL;
  const double turn = glm::dot(glm::cross(f.corner[0], f.corner[1]), f.corner[2]) > 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, turn * glm::dot(glm::normalize(glm::cross(f.corner[i], f.corner[(i + 1) % 3])), d));
  }
  return least;
}

TEST(Bounds, ConesKeepEveryCapThatTheFaceReachesAndFillOnlyWhatItFills) {
  Random random(0x5eed0065);
  const SpaceVector frame = SpaceVector::looking_along(Vector(0), DVector(1, -2, 0.5));
  int rejected = 0, covered = 0;
  for (const Facing& f : random_faces(4000, frame, random)) {
    for (int i = 0; i < 30; ++i) {
      const Cone::Radius radius(std::pow(2.0, random.between(-20.0, 0.6)));
      // A point of the face, and a cap that just reaches it, or does not.
      double p = random.unit(), q = random.unit();
      if (p + q > 1) p = 1 - p, q = 1 - q;
      if (i % 3 == 0) q = 0;               // on an edge
      if (i % 6 == 0) p = i % 12 ? 1 : 0;  // at a corner
      const DVector on_face =
          glm::normalize(f.corner[0] + p * (f.corner[1] - f.corner[0]) + q * (f.corner[2] - f.corner[0]));
      const DVector reaching = tilted(on_face, radius.rho * random.between(0.99, 1.0) * (1 - 1e-9), random);
      ASSERT_TRUE(f.cone.may_meet(reaching, radius)) << radius.rho;
      const DVector c = tilted(on_face, 2 * radius.rho * random.unit(), random);
      rejected += !f.cone.may_meet(c, radius);
      if (!f.cone.surely_covers(c, radius)) continue;
      ++covered;
      const double farthest = f.cone.farthest(c, radius);
      const DVector normal = glm::cross(f.corner[1] - f.corner[0], f.corner[2] - f.corner[0]);
      for (int k = 0; k < 12; ++k) {
        const DVector d = tilted(c, radius.rho, random);
        ASSERT_GT(depth_inside(f, d), -1e-9) << radius.rho;
        const double distance = glm::dot(normal, f.corner[0]) / glm::dot(normal, d);
        ASSERT_LE(distance, farthest * (1 + 1e-9)) << radius.rho;
      }
    }
  }
  EXPECT_GT(rejected, 5000);
  EXPECT_GT(covered, 1000);
}

// An edge nearly along its line of sight leaves the direction of its plane to the last bits. The frame is aslant:
// along the axes products of floats would be exact.
TEST(Bounds, ConesOfFacesSeenNearlyAlongAnEdgeKeepTheirCaps) {
  Random random(0x5eed0066);
  const SpaceVector frame = SpaceVector::looking_along(Vector(0), DVector(3, 1, -2));
  for (int i = 0; i < 20000; ++i) {
    const DVector along = random.direction();
    const Vector a = rounded(along * random.between(1.0, 2.0)), b = rounded(along * random.between(3.0, 4.0));
    const double aside = std::pow(2.0, random.between(-24.0, -2.0));
    const Vector c = rounded(along * 2.5 + aside * random.direction());
    const Triangle face{a, b, c};
    const int s = side(face, Vector(0));
    if (s == 0) continue;
    const Cone cone(face, s, frame);
    const Cone::Radius radius(0x1p-40);
    for (const Vector& corner : face) {
      ASSERT_TRUE(cone.may_meet(glm::normalize(frame.local_from_world(DVector(corner))), radius));
    }
  }
}

// The origin is a hair above a face's plane: what rounding does to the normal is then a large share of the distance.
TEST(Bounds, ConesOfFacesJustBelowTheOriginAreNotNearerThanTheyAre) {
  Random random(0x5eed0067);
  for (int i = 0; i < 2000; ++i) {
    const auto below = static_cast<float>(std::pow(2.0, random.between(-45.0, -25.0)));
    const SpaceVector frame = SpaceVector::looking_along(Vector(0), random.direction());
    const Triangle face{Vector(5, 3, -below), Vector(-7, 2, -below), Vector(1, -6, -below)};
    const Cone cone(face, side(face, Vector(0)), frame);
    const DVector d = tilted({0, 0, -1}, random.between(0.0, 1.4), random);
    const Cone::Radius radius(0x1p-40);
    const DVector c = frame.local_from_world(d);
    ASSERT_TRUE(cone.surely_covers(c, radius));
    ASSERT_GE(cone.farthest(c, radius), static_cast<double>(below) / -d.z * (1 - kRounding)) << below;
  }
}

TEST(Bounds, AListIsCutOnlyBehindItsMargin) {
  constexpr float kCut = 2;
  constexpr double kMargin = Texels::kDepthMargin;
  // Queries up to (1 + margin) beyond the cut read the list: all faces that begin there must be in it.
  for (const double nearest : {1.0, double(kCut), kCut * (1 + 0.9 * kMargin), kCut * (1 + 1.5 * kMargin)}) {
    EXPECT_FALSE(Texels::is_hidden(static_cast<float>(nearest), kCut)) << nearest;
  }
  EXPECT_TRUE(Texels::is_hidden(3, kCut));
}

}  // namespace
