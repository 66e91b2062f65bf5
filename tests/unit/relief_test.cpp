#include "material/relief.h"

#include <facemap/projection.h>
#include <facemap/space_vector.h>
#include <gtest/gtest.h>

#include "material/footprint.h"
#include "render/neighbour_rays.h"
#include "support/random.h"

namespace facemap {
namespace {

// The square's lower left half in z = 0, seen from +z; its image's places go to the right and down.
FaceCorners flat_face() {
  FaceCorners face{{DVector(0, 0, 0), DVector(2, 0, 0), DVector(0, 1, 0)}, {}};
  face.n = cross(face.v[1] - face.v[0], face.v[2] - face.v[0]);
  return face;
}

void expect_near(const DVector& a, const DVector& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

TEST(Relief, AxesGoRightAndUpInTheImage) {
  const TexturePoint upright[3] = {{0, 1}, {1, 1}, {0, 0}};
  const ImageAxes axes(flat_face(), upright);
  expect_near(axes.right, {1, 0, 0});
  expect_near(axes.up, {0, 1, 0});
  const TexturePoint mirrored[3] = {{1, 1}, {0, 1}, {1, 0}};
  expect_near(ImageAxes(flat_face(), mirrored).right, {-1, 0, 0});
  expect_near(ImageAxes(flat_face(), mirrored).up, {0, 1, 0});
  const TexturePoint none[3] = {{0, 0}, {0, 0}, {0, 0}};
  EXPECT_EQ(ImageAxes(flat_face(), none).right, DVector(0));
}

TEST(Relief, NormalsTiltRightAndUp) {
  const TexturePoint upright[3] = {{0, 1}, {1, 1}, {0, 0}}, mirrored[3] = {{1, 1}, {0, 1}, {1, 0}};
  const DVector front(0, 0, 1), local(0.6, 0.0, 0.8), up(0, 0.6, 0.8);
  expect_near(tilted(front, ImageAxes(flat_face(), upright), local, false), {0.6, 0, 0.8});
  expect_near(tilted(front, ImageAxes(flat_face(), upright), up, false), {0, 0.6, 0.8});
  expect_near(tilted(front, ImageAxes(flat_face(), mirrored), local, false), {-0.6, 0, 0.8});
  expect_near(tilted(front, ImageAxes(flat_face(), mirrored), up, false), {0, 0.6, 0.8});
  // From behind the same relief: the normal of the other side.
  expect_near(tilted(-front, ImageAxes(flat_face(), upright), local, true), {-0.6, 0, -0.8});
  expect_near(tilted(front, ImageAxes(flat_face(), upright), {0, 0, 1}, false), front);
  const TexturePoint none[3] = {{0, 0}, {0, 0}, {0, 0}};
  expect_near(tilted(front, ImageAxes(flat_face(), none), local, false), front);
}

TEST(SurfaceCoordinates, WeightsAndTextureCoordinatesAreLinear) {
  const FaceCorners face = flat_face();
  const DVector p = point_on_plane(face, {0.5, 0.25, 7}, {0, 0, -3});
  expect_near(p, {0.5, 0.25, 0});
  expect_near(barycentric(face, p), {0.5, 0.25, 0.25});
  const CornerCoordinates corners{{{0, 0}, {4, 0}, {0, 8}}};
  const TexturePoint uv = weighted(corners.uv, barycentric(face, p));
  EXPECT_DOUBLE_EQ(uv.x, 1);
  EXPECT_DOUBLE_EQ(uv.y, 2);
  const TexturePoint change = CoordinateGradient(face, corners).at({1, 0.5, 100});
  EXPECT_DOUBLE_EQ(change.x, 2);
  EXPECT_DOUBLE_EQ(change.y, 4) << "along the plane alone";
}

// The footprint beside the true difference of texture coordinates, by rays a small step apart, for both projections,
// in the middle of a picture and far off its axis.
TEST(Footprint, IsHowFarNeighboursAreApart) {
  Random random(3);
  const SpaceVector frame = SpaceVector::looking_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
  for (int i = 0; i < 300; ++i) {
    const bool plane = random.chance(0.5);
    const Projection projection(plane ? ProjectionKind::Plane : ProjectionKind::Surface,
                                random.between(0.5, plane ? 2.5 : 6.2), 500, 500);
    const MapPoint point(random.between(150.0, 350.0), random.between(150.0, 350.0));
    RayBundle rays;
    rays.through = Vector(frame.world_from_local(projection.local_from_map(point)));
    set_neighbours(frame, projection, point, 0.25, rays);
    const DVector centre = DVector(rays.through) * random.between(1.0, 50.0);
    FaceCorners face{{centre + random.in_cube(), centre + random.in_cube(), centre + random.in_cube()}, {}};
    face.n = cross(face.v[1] - face.v[0], face.v[2] - face.v[0]);
    // Neighbours that meet the plane nearly as steeply as the ray does: first order is all there is.
    if (std::fabs(dot(normalized(face.n), normalized(DVector(rays.through)))) < 0.3) continue;
    const CornerCoordinates corners{{{random.unit(), 0}, {1, random.unit()}, {random.unit(), 1}}};
    const CoordinateGradient gradient(face, corners);
    const Footprint footprint = footprint_of(face, gradient, DVector(0), rays);
    const DVector here = point_on_plane(face, DVector(0), DVector(rays.through));
    const TexturePoint right = gradient.at(point_on_plane(face, DVector(0), DVector(rays.right)) - here);
    const TexturePoint down = gradient.at(point_on_plane(face, DVector(0), DVector(rays.down)) - here);
    const double size = std::max({std::fabs(right.x), std::fabs(right.y), std::fabs(down.x), std::fabs(down.y)});
    EXPECT_NEAR(footprint.right.x, right.x, 0.05 * size);
    EXPECT_NEAR(footprint.right.y, right.y, 0.05 * size);
    EXPECT_NEAR(footprint.down.x, down.x, 0.05 * size);
    EXPECT_NEAR(footprint.down.y, down.y, 0.05 * size);
  }
}

TEST(Footprint, IsFiniteWhereTheNeighbourPassesTheHorizon) {
  const FaceCorners face = flat_face();
  const CoordinateGradient gradient(face, {{{0, 0}, {1, 0}, {0, 1}}});
  const RayBundle grazing{{1, 0, -0.001f}, {1, 0, 0.001f}, {1, 0.01f, -0.001f}};
  const RayBundle along{{1, 0, 0}, {1, 0, 0.01f}, {1, 0.01f, 0}};
  for (const RayBundle& rays : {grazing, along}) {
    const Footprint footprint = footprint_of(face, gradient, {-5, 0, 0.001}, rays);
    for (const double x : {footprint.right.x, footprint.right.y, footprint.down.x, footprint.down.y}) {
      EXPECT_TRUE(std::isfinite(x));
    }
  }
}

}  // namespace
}  // namespace facemap
