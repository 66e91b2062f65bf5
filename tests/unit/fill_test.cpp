#include "map/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "support/scenes.h"

namespace {

using facemap::DVector;
using facemap::fill_faces;
using facemap::MapPoint;
using facemap::Mesh;
using facemap::Projection;
using facemap::ProjectionKind;
using facemap::Scene;
using facemap::SpaceVector;
using facemap::TexelEntry;
using facemap::Vector;
using facemap::elementary::kPi;

constexpr double kDegree = kPi / 180;

std::vector<TexelEntry> fill(const Scene& scene, const SpaceVector& frame, const Projection& projection) {
  std::vector<TexelEntry> entries;
  fill_faces(scene, frame, projection, entries);
  return entries;
}

// A view whose local axes are (x, y, -z) of the world.
SpaceVector ahead() { return SpaceVector::looking_at(Vector(0), Vector(0, 0, -1)); }

Mesh triangle(const Vector& a, const Vector& b, const Vector& c) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, a, b, c);
  return mesh;
}

bool holds(const std::vector<TexelEntry>& entries, const TexelEntry& entry) {
  return std::binary_search(entries.begin(), entries.end(), entry, [](const TexelEntry& a, const TexelEntry& b) {
    return a.face < b.face || (a.face == b.face && a.texel < b.texel);
  });
}

// Sine of the angle by which direction d lies inside the face's cone about the frame (negative: outside); for an
// outside direction a lower bound of the true one. 0 for a face seen edge-on.
double sine_inside(const Scene& scene, std::uint32_t face, const SpaceVector& frame, const DVector& d) {
  DVector v[3];
  for (int i = 0; i < 3; ++i) {
    v[i] = frame.local_from_world(DVector(scene.mesh().vertex(face, i)) - DVector(frame.position()));
  }
  const double s = glm::dot(glm::cross(v[1] - v[0], v[2] - v[0]), v[0]) < 0 ? -1 : 1;
  double sine = 1;
  for (int i = 0; i < 3; ++i) {
    const DVector n = glm::cross(v[i], v[(i + 1) % 3] - v[i]);
    if (glm::length(n) == 0) return 0;
    sine = std::min(sine, s * glm::dot(n, d) / glm::length(n));
  }
  return sine;
}

// A piece of a curve is a pixel long at most, so its chord leaves the curve by less than half a pixel: a texel whose
// centre is farther than that from a face's border is in the face if and only if its centre is. A texel of the
// curve itself has its centre within sqrt(1/2) pixel of it. In angle a pixel is never wider than texel_angle().
void expect_filled_as_seen(const Scene& scene, const SpaceVector& frame, const Projection& projection,
                           const std::string& what) {
  const std::vector<TexelEntry> entries = fill(scene, frame, projection);
  const double certain = std::sin(std::min(kPi / 2, 0.51 * projection.texel_angle()));
  const double possible = std::sin(std::min(kPi / 2, 0.72 * projection.texel_angle()));
  for (int row = 0; row < projection.height(); ++row) {
    for (int column = 0; column < projection.width(); ++column) {
      const MapPoint centre(column + 0.5, row + 0.5);
      if (!projection.has_direction(centre)) continue;
      const DVector d = projection.local_from_map(centre);
      for (const std::uint32_t face : scene.kept_faces()) {
        const double sine = sine_inside(scene, face, frame, d);
        const bool is_in = holds(entries, {static_cast<std::uint32_t>(row * projection.width() + column), face});
        if (sine > certain) {
          ASSERT_TRUE(is_in) << what << ": face " << face << " is missing in " << column << ' ' << row;
        } else if (sine < -possible) {
          ASSERT_FALSE(is_in) << what << ": face " << face << " is not in " << column << ' ' << row;
        }
      }
    }
  }
}

TEST(Fill, TexelsAreThoseWithinTheCurves) {
  Random random(41);
  const double fields[] = {50, 90, 120, 170, 180, 360};
  for (int i = 0; i < 240; ++i) {
    const auto kind = static_cast<test_scenes::Kind>(i % test_scenes::kKindCount);
    const test_scenes::TestScene made = test_scenes::make_scene(kind, 30, random);
    const Scene scene(made.mesh);
    const Vector origin(DVector(made.centre) + random.in_cube() * (0.7 * made.radius));
    const SpaceVector frame = SpaceVector::looking_along(origin, random.direction());
    const double field = fields[i % 6];
    expect_filled_as_seen(scene, frame, Projection(ProjectionKind::Surface, field * kDegree, 40, 32),
                          made.name + ", scene " + std::to_string(i));
    if (field < 180) {
      expect_filled_as_seen(scene, frame, Projection(ProjectionKind::Plane, field * kDegree, 40, 32),
                            made.name + " on a plane, scene " + std::to_string(i));
    }
  }
}

TEST(Fill, EdgesAndVerticesAcrossTheAntipodeAndTheAxisAreFilledOnTheirOwnSide) {
  // Boxes whose diagonals, edges or corners meet the sight axis exactly on both ends.
  const Projection map(ProjectionKind::Surface, 2 * kPi, 48, 48);
  const Scene diagonal(test_scenes::box(Vector(-1, -1, -1), Vector(1, 1, 1)));
  expect_filled_as_seen(diagonal, ahead(), map, "diagonal");
  expect_filled_as_seen(diagonal, SpaceVector::looking_at(Vector(0), Vector(1, 0, 1)), map, "edge");
  expect_filled_as_seen(diagonal, SpaceVector::looking_at(Vector(0), Vector(1, 1, 1)), map, "corner");
  Mesh fan;  // eight faces around the antipode
  for (int i = 0; i < 8; ++i) {
    const auto rim = [](int k) {
      return Vector(static_cast<float>(std::cos(k * kPi / 4)), static_cast<float>(std::sin(k * kPi / 4)), 1);
    };
    test_scenes::add_triangle(fan, Vector(0, 0, 1), rim(i), rim(i + 1));
  }
  expect_filled_as_seen(Scene(fan), ahead(), map, "fan");
}

TEST(Fill, EveryDirectionInAClosedBodyHasAFace) {
  const Scene scene(test_scenes::uv_sphere(24, 12, DVector(0.1, -0.2, 0.15), 1));
  const Projection map(ProjectionKind::Surface, 2 * kPi, 64, 64);
  std::vector<int> faces(64 * 64, 0);
  for (const TexelEntry& entry : fill(scene, ahead(), map)) ++faces[entry.texel];
  for (int texel = 0; texel < 64 * 64; ++texel) {
    if (map.has_direction({texel % 64 + 0.5, texel / 64 + 0.5})) {
      EXPECT_GE(faces[texel], 1) << texel;
    }
  }
}

TEST(Fill, AFaceBetweenAllTexelCentresIsNotLost) {
  const Projection map(ProjectionKind::Surface, kPi / 2, 32, 32);
  const Scene scene(triangle(Vector(0.001f, 0.001f, -1), Vector(0.002f, 0.001f, -1), Vector(0.001f, 0.002f, -1)));
  const std::vector<TexelEntry> entries = fill(scene, ahead(), map);
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].texel, 15u * 32 + 16);  // right of the axis and above it
}

TEST(Fill, AFaceSeenEdgeOnHasNoTexel) {
  EXPECT_TRUE(fill(Scene(triangle(Vector(0, 0, -1), Vector(0, 1, -1), Vector(0, 0, -2))), ahead(),
                   Projection(ProjectionKind::Surface, 2 * kPi, 32, 32))
                  .empty());
  // The origin is on the face itself.
  EXPECT_TRUE(fill(Scene(triangle(Vector(-1, -1, 0), Vector(1, -1, 0), Vector(0, 2, 0))), ahead(),
                   Projection(ProjectionKind::Surface, 2 * kPi, 32, 32))
                  .empty());
}

TEST(Fill, PlaneProjectionClipsWhatIsBehindTheCamera) {
  const Projection map(ProjectionKind::Plane, kPi / 2, 32, 32);
  EXPECT_TRUE(fill(Scene(triangle(Vector(-1, 0, 1), Vector(1, 0, 1), Vector(0, 1, 2))), ahead(), map).empty());
  // A floor from far before to far behind: the lower half of the picture, all columns.
  Mesh floor = triangle(Vector(-1e3f, -1, -1e3f), Vector(1e3f, -1, -1e3f), Vector(1e3f, -1, 1e3f));
  test_scenes::add_triangle(floor, Vector(-1e3f, -1, -1e3f), Vector(1e3f, -1, 1e3f), Vector(-1e3f, -1, 1e3f));
  std::vector<int> faces(32 * 32, 0);
  for (const TexelEntry& entry : fill(Scene(floor), ahead(), map)) ++faces[entry.texel];
  for (int texel = 0; texel < 32 * 32; ++texel) {
    if (texel / 32 >= 17) {
      EXPECT_GE(faces[texel], 1) << texel;
    } else if (texel / 32 < 15) {
      EXPECT_EQ(faces[texel], 0) << texel;
    }
  }
}

TEST(Fill, EntriesAreInFaceOrderAndTexelsAscendWithoutRepeats) {
  const Scene scene(test_scenes::uv_sphere(16, 8, DVector(0), 1));
  const std::vector<TexelEntry> entries =
      fill(scene, SpaceVector::looking_along(Vector(0.2f, 0.1f, 0.3f), DVector(0.3, 0.2, -1)),
           Projection(ProjectionKind::Surface, 2 * kPi, 64, 48));
  ASSERT_FALSE(entries.empty());
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const TexelEntry &a = entries[i - 1], &b = entries[i];
    EXPECT_TRUE(a.face < b.face || (a.face == b.face && a.texel < b.texel)) << i;
    EXPECT_LT(b.texel, 64u * 48);
  }
}

TEST(Fill, AppendsAndLeavesOddFacesOut) {
  Mesh mesh = triangle(Vector(-1, -1, -2), Vector(1, -1, -2), Vector(0, 1, -2));
  test_scenes::add_triangle(mesh, Vector(0, 0, -1), Vector(0.5f, 0, -1), Vector(1, 0, -1));  // no area
  const Scene scene(mesh);
  std::vector<TexelEntry> entries{{7, 7}};
  fill_faces(scene, ahead(), Projection(ProjectionKind::Surface, kPi / 2, 32, 32), entries);
  ASSERT_GT(entries.size(), 10u);
  EXPECT_EQ(entries[0].face, 7u);
  for (std::size_t i = 1; i < entries.size(); ++i) EXPECT_EQ(entries[i].face, 0u);
}

}  // namespace
