#include "map/cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "map/cone.h"
#include "math/elementary.h"
#include "support/random.h"

namespace {

using facemap::DVector;
using facemap::MapPoint;
using facemap::Projection;
using facemap::ProjectionKind;
using facemap::Scene;
using facemap::SpaceVector;
using facemap::Vector;

double dot(const DVector& a, const DVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const DVector& a) { return std::sqrt(dot(a, a)); }
DVector cross(const DVector& a, const DVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

TEST(Cover, BulgeBoundsTheImageOfAnEdgeAndIsTight) {
  Random random(1);
  // Unit scale: a map point is measured in radians.
  const Projection unit(ProjectionKind::Surface, 2 * facemap::elementary::kPi, 1000, 1000);
  const double tau = unit.texel_angle();
  for (const double beta : {0.05, 0.3, 1.0, 1.6, 2.0, 2.3, 2.6}) {
    double tightest = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const double alpha = 0.02 + 0.2 * random.unit();
      const double at = beta - alpha * random.unit(), turn = 6.2831853 * random.unit();
      const DVector start(std::sin(at), 0, std::cos(at));
      const DVector tangent(std::cos(turn) * std::cos(at), std::sin(turn), -std::cos(turn) * std::sin(at));
      double farthest = 0;
      for (int i = 0; i <= 32; ++i) {
        const DVector p = start * std::cos(alpha * i / 32) + tangent * std::sin(alpha * i / 32);
        farthest = std::max(farthest, std::acos(std::clamp(p.z, -1.0, 1.0)));
      }
      if (farthest > beta) continue;
      const MapPoint a = unit.map_from_local(start);
      const MapPoint b = unit.map_from_local(start * std::cos(alpha) + tangent * std::sin(alpha));
      const double bound = facemap::bulge(alpha, beta) / tau;
      for (int i = 1; i < 32; ++i) {
        const double share = i / 32.0;
        const MapPoint p = unit.map_from_local(start * std::cos(alpha * share) + tangent * std::sin(alpha * share));
        const double deviation = std::hypot(p.x - (a.x + share * (b.x - a.x)), p.y - (a.y + share * (b.y - a.y)));
        ASSERT_LE(deviation, bound) << "beta " << beta << " alpha " << alpha << " at " << at << " turn " << turn;
        tightest = std::max(tightest, deviation / bound);
      }
    }
    EXPECT_GT(tightest, 0.6) << "a bound half as large would not hold, beta " << beta;
  }
}

Scene scene_of_one(const Vector& a, const Vector& b, const Vector& c) {
  facemap::Mesh mesh;
  mesh.positions = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return Scene(std::move(mesh));
}

// Directions of a face: corners, points of edges, the inside.
DVector point_of_face(const Scene& scene, Random& random, int kind) {
  double u = random.unit(), v = random.unit();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  if (kind == 0) u = v = 0;
  if (kind == 1) v = 0;
  if (kind == 2) v = 1 - u;
  const auto& p = scene.mesh().positions;
  return DVector(p[0]) * (1 - u - v) + DVector(p[1]) * u + DVector(p[2]) * v;
}

TEST(Cover, EveryTexelThatAFaceIsMappedIntoHoldsIt) {
  Random random(2);
  for (int trial = 0; trial < 1500; ++trial) {
    const double size = std::pow(10.0, -3 + 4 * random.unit());
    const auto near = [&](double s) {
      return Vector(float((2 * random.unit() - 1) * s), float((2 * random.unit() - 1) * s),
                    float((2 * random.unit() - 1) * s));
    };
    const Vector a = near(2);
    const Scene scene = scene_of_one(a, a + near(size), trial % 3 == 0 ? a + near(size * 1e-3) : a + near(size));
    if (scene.kept_faces().empty()) continue;
    const SpaceVector frame = SpaceVector::looking_along(Vector(0.1f, -0.2f, 0.05f), DVector(near(1)));
    const facemap::FacePlanesTable planes(scene, frame.position());
    if (planes.side(0) == 0) continue;
    const ProjectionKind kind = trial % 4 == 0 ? ProjectionKind::Plane : ProjectionKind::Surface;
    const double field = kind == ProjectionKind::Plane ? 1.5 : trial % 2 ? 2 * facemap::elementary::kPi : 2.5;
    const Projection projection(kind, field, 96, 64);
    const facemap::Coverage coverage = facemap::cover_faces(scene, frame, projection, planes, false);
    std::set<std::uint32_t> texels;
    for (const facemap::TexelEntry& entry : coverage.entries) {
      EXPECT_TRUE(texels.insert(entry.texel).second) << "a texel holds a face once";
    }
    for (int i = 0; i < 200; ++i) {
      const DVector local = frame.local_from_world(point_of_face(scene, random, i % 5) - DVector(frame.position()));
      if (!projection.is_mapped(local)) continue;
      const MapPoint p = projection.map_from_local(local);
      if (!(p.x >= 0 && p.x < 96 && p.y >= 0 && p.y < 64)) continue;
      ASSERT_TRUE(texels.count(static_cast<std::uint32_t>(p.y) * 96 + static_cast<std::uint32_t>(p.x)))
          << "trial " << trial << " texel " << p.x << " " << p.y;
    }
  }
}

TEST(Cover, CutIsNoNearerThanTheFaceAndCoversTheWholeTexel) {
  // A wall across the sight: every direction of a texel with a cut meets it, no farther than the cut.
  const Scene scene = scene_of_one({-9, -9, -2}, {9, -9, -3}, {0, 12, -2.5f});
  const SpaceVector frame = SpaceVector::looking_along(Vector(0), DVector(0, 0, -1));
  const facemap::FacePlanesTable planes(scene, Vector(0));
  const Projection projection(ProjectionKind::Surface, 2.4, 32, 32);
  const facemap::Coverage coverage = facemap::cover_faces(scene, frame, projection, planes, false);
  const facemap::Triangle face = facemap::triangle_of(scene, 0);
  const DVector n = cross(DVector(face[1]) - DVector(face[0]), DVector(face[2]) - DVector(face[0]));
  Random random(3);
  int cut = 0;
  for (int texel = 0; texel < 32 * 32; ++texel) {
    const float limit = coverage.cuts[static_cast<std::size_t>(texel)];
    if (limit == INFINITY) continue;
    ++cut;
    for (int i = 0; i < 20; ++i) {
      const MapPoint p(texel % 32 + random.unit(), texel / 32 + random.unit());
      const Vector d(frame.world_from_local(projection.local_from_map(p)));
      ASSERT_TRUE(facemap::covers(face, planes.side(0), Vector(0), d).strictly_inside);
      const double distance = dot(n, DVector(face[0])) / dot(n, DVector(d)) * length(DVector(d));
      ASSERT_LE(distance * planes.scale(), limit);
      ASSERT_GE(distance * planes.scale(), limit * 0.5) << "the bound is tight enough to be of use";
    }
  }
  EXPECT_GT(cut, 300);
}

TEST(Cover, SmallFacesTakeFewTexels) {
  Random random(4);
  const Projection projection(ProjectionKind::Surface, 2.0, 256, 256);
  const SpaceVector frame = SpaceVector::looking_along(Vector(0), DVector(0, 0, -1));
  std::size_t entries = 0;
  constexpr int kFaces = 500;
  for (int i = 0; i < kFaces; ++i) {
    const Vector a(float(random.unit() - 0.5), float(random.unit() - 0.5), -1);
    const Scene scene = scene_of_one(a, a + Vector(0.008f, 0, 0), a + Vector(0, 0.008f, 0));  // about one texel
    const facemap::FacePlanesTable planes(scene, Vector(0));
    entries += facemap::cover_faces(scene, frame, projection, planes, false).entries.size();
  }
  EXPECT_LT(entries, kFaces * 6u);
}

}  // namespace
